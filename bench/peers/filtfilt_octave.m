% The chain of signal_bench.cc in Octave: prints `octave VERSION MEDIAN_CPU_ms RMS_m`.
pkg load signal
N = 1000000; period = 0.25e-3; spacing = 0.025; cutoff = 0.4;
k = (0:N-1)';
a = sin(0.05 * k) + 0.5 * cos(0.31 * k);
s = spacing * (k + 0.3 * sin(0.7 * k));
grid = spacing * (0:N-2)';
% Each pass at 0.802 of the cut-off, as an analogue frequency: -3 dB for both together.
corner = atan((sqrt(2) - 1)^0.25 * tan(pi * cutoff * spacing)) / (pi * spacing);
[b, c] = butter(2, 2 * spacing * corner, 'high');
times = [];
for run = 1:9
  start = cputime();
  step = a * period^2;
  step(1) *= 0.5;
  h = [0; cumsum(cumsum(step))(1:end-1)];
  x = filtfilt(b, c, interp1(s, h, grid));
  times(end+1) = cputime() - start;
end
middle = x(floor(numel(x)/4)+1 : floor(3*numel(x)/4));
printf("octave %s %.3f %.9e\n", version(), 1e3 * median(times), sqrt(mean(middle.^2)));
