using System;

namespace Asperity.Feel
{
    /// <summary>
    /// The tip's motion between the positions that an application has once a frame. One frame late, and straight from
    /// each to the next: the position is continuous, the velocity that of the frame. Without a new position for
    /// `Stale_s` there is none. Not synchronised.
    /// </summary>
    public sealed class TargetTrack
    {
        /// <summary>Longest time without a new position, s.</summary>
        public const double Stale_s = 0.1;

        /// <summary>A step beyond this is a jump of the tracker, not a motion, m/s.</summary>
        public const double Fastest_mps = 5.0;

        private int count;
        private double before_s, last_s;
        private Vector before_m, last_m;

        /// <summary>Forgets all positions.</summary>
        public void Clear() { count = 0; }

        /// <summary>
        /// A position at a time of the application's clock, s. False, and all earlier ones forgotten, where it is not
        /// finite, or farther than the hand can have moved. A time that does not rise is left out.
        /// </summary>
        public bool Push(double t_s, Vector position_m)
        {
            if (!position_m.IsFinite || double.IsNaN(t_s) || double.IsInfinity(t_s)) { Clear(); return false; }
            if (count > 0 && !(t_s > last_s)) return true;
            if (count > 0 && t_s - last_s > Stale_s) Clear();
            bool jumps = count > 0 && (position_m - last_m).Length > Fastest_mps * (t_s - last_s);
            if (jumps) Clear();
            before_s = last_s;
            before_m = last_m;
            last_s = t_s;
            last_m = position_m;
            count = Math.Min(count + 1, 2);
            return !jumps;
        }

        /// <summary>Position (m) and velocity (m/s) for the time of a step; false if there is none.</summary>
        public bool At(double t_s, out Vector position_m, out Vector velocity_mps)
        {
            position_m = last_m;
            velocity_mps = new Vector();
            if (count < 2 || t_s - last_s > Stale_s || t_s < before_s) return false;
            double frame_s = last_s - before_s;
            double share = (t_s - last_s) / frame_s;  // one frame late: at last_s the tip is at before_m
            if (share >= 1.0) return true;            // the next frame is late: it rests
            if (share < 0.0) share = 0.0;
            position_m = before_m + share * (last_m - before_m);
            velocity_mps = (1.0 / frame_s) * (last_m - before_m);
            return true;
        }
    }
}
