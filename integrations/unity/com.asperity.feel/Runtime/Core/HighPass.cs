using System;

namespace Asperity.Feel
{
    /// <summary>
    /// Takes the static force and the hand's slow motion off a force: a second-order Butterworth high-pass by the bilinear
    /// transform, its -3 dB point exact. Belongs to one thread; allocates nothing.
    /// </summary>
    public sealed class HighPass
    {
        private readonly double b0, b1, a1, a2;
        private double s1, s2;

        public HighPass(double cutoff_Hz, double rate_Hz)
        {
            if (!(cutoff_Hz > 0.0 && rate_Hz > 2.0 * cutoff_Hz))
                throw new ArgumentException("cutoff_Hz must be positive and below half of rate_Hz");
            double k = Math.Tan(Math.PI * cutoff_Hz / rate_Hz), a0 = 1.0 + Math.Sqrt(2.0) * k + k * k;
            b0 = 1.0 / a0;
            b1 = -2.0 / a0;
            a1 = 2.0 * (k * k - 1.0) / a0;
            a2 = (1.0 - Math.Sqrt(2.0) * k + k * k) / a0;
        }

        /// <summary>As if `x` had been its input for ever: what follows an interruption is no step.</summary>
        public void StartAt(double x)
        {
            s1 = -b0 * x;
            s2 = b0 * x;
        }

        public double Push(double x)
        {
            double y = b0 * x + s1;
            s1 = b1 * x - a1 * y + s2;
            s2 = b0 * x - a2 * y;
            return y;
        }
    }
}
