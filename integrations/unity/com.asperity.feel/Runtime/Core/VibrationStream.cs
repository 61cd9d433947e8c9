using System;

namespace Asperity.Feel
{
    /// <summary>
    /// Carries the vibrating part of the force from the haptic loop to sound, for a voice coil. One thread pushes, one
    /// fills; neither waits nor allocates. What is below HapticLoop.LowestVibration_Hz is taken off (HighPass): a force that
    /// rests is no sound. Between two forces the sound is straight; without new forces it fades out in 10 ms.
    /// </summary>
    public sealed class VibrationStream
    {
        private const double Fade_s = 0.010;

        private readonly float[] ring;
        private readonly double rate_Hz;
        private readonly HighPass highPass;  // of the loop alone, as is `settled`
        private bool settled = true;         // the hand was free before the first force
        private long pushed;   // written by the loop alone
        private double read;   // read position in forces, of the sound alone
        private double last, level;
        private bool running;
        private long ended;    // forces that had come when the sound ran out of them

        /// <summary>`rate_Hz` of the forces; at most `capacity` of them wait.</summary>
        public VibrationStream(double rate_Hz, int capacity)
        {
            if (!(rate_Hz > 0.0) || capacity < 16) throw new ArgumentException("rate_Hz must be positive, capacity at least 16");
            this.rate_Hz = rate_Hz;
            highPass = new HighPass(HapticLoop.LowestVibration_Hz, rate_Hz);
            ring = new float[capacity];
        }

        /// <summary>
        /// From the haptic loop, one a step: Touch.Vibration_N, static force and all. One that is not finite is ignored.
        /// </summary>
        public void Push(double vibration_N)
        {
            if (double.IsNaN(vibration_N) || double.IsInfinity(vibration_N)) return;
            if (!settled) highPass.StartAt(vibration_N);
            settled = true;
            long at = System.Threading.Volatile.Read(ref pushed);
            ring[at % ring.Length] = (float)highPass.Push(vibration_N);
            System.Threading.Volatile.Write(ref pushed, at + 1);
        }

        /// <summary>From the haptic loop: the tip was lifted or set down elsewhere, so the next force is no tap.</summary>
        public void Interrupt() { settled = false; }

        /// <summary>
        /// Writes sound from -1 to 1 into all channels of `data` (interleaved). `fullScale_N` is the force that is 1 at
        /// volume 1.
        /// </summary>
        public void Fill(float[] data, int channels, double sampleRate_Hz, double volume, double fullScale_N)
        {
            double step = rate_Hz / sampleRate_Hz, gain = volume / fullScale_N;
            double fade = Math.Exp(-1.0 / (Fade_s * sampleRate_Hz));
            long until = System.Threading.Volatile.Read(ref pushed);
            int frames = data.Length / channels;
            // A third of the ring, or what one call takes, is kept in advance.
            double behind = Math.Min(ring.Length / 2.0, Math.Max(ring.Length / 3.0, frames * step + 2.0));
            if (running && until - read > ring.Length - 2) running = false;  // the loop has overtaken it
            if (!running && until - ended >= behind + 2) { read = until - behind; running = true; }
            for (int i = 0; i < frames; ++i)
            {
                if (running && read + 1.0 < until)
                {
                    long first = (long)read;
                    double share = read - first;
                    last = (1.0 - share) * ring[first % ring.Length] + share * ring[(first + 1) % ring.Length];
                    read += step;
                    level += (1.0 - level) * (1.0 - fade);
                }
                else
                {
                    if (running) ended = until;
                    running = false;
                    level *= fade;
                }
                double sound = Math.Max(-1.0, Math.Min(1.0, gain * level * last));
                for (int c = 0; c < channels; ++c) data[i * channels + c] = (float)sound;
            }
        }
    }
}
