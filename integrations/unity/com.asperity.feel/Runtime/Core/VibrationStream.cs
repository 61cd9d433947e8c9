using System;

namespace Asperity.Feel
{
    /// <summary>
    /// Carries the vibrating part of the force from the haptic loop to sound, for a voice coil. One thread pushes, one
    /// fills; neither waits nor allocates. Between two forces the sound is straight; without new forces it fades out in
    /// 10 ms. Frequencies below 20 Hz are taken off (first order), as a voice coil has none.
    /// </summary>
    public sealed class VibrationStream
    {
        private const double Highpass_Hz = 20.0, Fade_s = 0.010;

        private readonly float[] ring;
        private readonly double rate_Hz;
        private long pushed;   // written by the loop alone
        private double read;   // read position in forces, of the sound alone
        private double lastIn, lastOut, level;
        private bool running;
        private long ended;    // forces that had come when the sound ran out of them

        /// <summary>`rate_Hz` of the forces; at most `capacity` of them wait.</summary>
        public VibrationStream(double rate_Hz, int capacity)
        {
            if (!(rate_Hz > 0.0) || capacity < 16) throw new ArgumentException("rate_Hz must be positive, capacity at least 16");
            this.rate_Hz = rate_Hz;
            ring = new float[capacity];
        }

        /// <summary>From the haptic loop, one a step.</summary>
        public void Push(double vibration_N)
        {
            long at = System.Threading.Volatile.Read(ref pushed);
            ring[at % ring.Length] = double.IsNaN(vibration_N) ? 0f : (float)vibration_N;
            System.Threading.Volatile.Write(ref pushed, at + 1);
        }

        /// <summary>
        /// Writes sound from -1 to 1 into all channels of `data` (interleaved). `fullScale_N` is the force that is 1 at
        /// volume 1.
        /// </summary>
        public void Fill(float[] data, int channels, double sampleRate_Hz, double volume, double fullScale_N)
        {
            double step = rate_Hz / sampleRate_Hz, gain = volume / fullScale_N;
            double keep = Math.Exp(-2.0 * Math.PI * Highpass_Hz / sampleRate_Hz);
            double fade = Math.Exp(-1.0 / (Fade_s * sampleRate_Hz));
            long until = System.Threading.Volatile.Read(ref pushed);
            int frames = data.Length / channels;
            // A third of the ring, or what one call takes, is kept in advance.
            double behind = Math.Min(ring.Length / 2.0, Math.Max(ring.Length / 3.0, frames * step + 2.0));
            if (running && until - read > ring.Length - 2) running = false;  // the loop has overtaken it
            if (!running && until - ended >= behind + 2) { read = until - behind; running = true; }
            for (int i = 0; i < frames; ++i)
            {
                double force = 0.0;
                if (running && read + 1.0 < until)
                {
                    long first = (long)read;
                    double share = read - first;
                    force = (1.0 - share) * ring[first % ring.Length] + share * ring[(first + 1) % ring.Length];
                    read += step;
                    level = 1.0;
                }
                else
                {
                    if (running) ended = until;
                    running = false;
                    force = lastIn;
                    level *= fade;
                }
                lastOut = keep * (lastOut + force - lastIn);
                lastIn = force;
                double sound = Math.Max(-1.0, Math.Min(1.0, gain * level * lastOut));
                for (int c = 0; c < channels; ++c) data[i * channels + c] = (float)sound;
            }
        }
    }
}
