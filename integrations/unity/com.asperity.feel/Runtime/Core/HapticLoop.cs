using System;
using System.Diagnostics;
using System.Threading;

namespace Asperity.Feel
{
    /// <summary>
    /// Steps one tip on a thread of its own. The application gives a position once a frame (SetTarget) and reads the last
    /// touch. If no position comes for 0.1 s, the force is zero and the tip is lifted, as it is after a jump of the
    /// tracker. Nothing is allocated while it runs; a garbage collection of the application can still stop it for some
    /// milliseconds, which `LongestStep_s` shows. It drives no device: OnStep hands the force on.
    /// </summary>
    public sealed class HapticLoop : IDisposable
    {
        private readonly FeelTip tip;
        private readonly object gate = new object();  // held for some copies only
        private readonly TargetTrack track = new TargetTrack();
        private readonly Stopwatch clock = Stopwatch.StartNew();
        private readonly Thread thread;
        private readonly double rate_Hz;
        private volatile bool stop, disposesItself;
        private Touch shared = Touch.Create();
        private double longest_s, rumble;
        private long steps;
        private Exception fault;

        /// <summary>Takes the tip over: it is disposed with the loop.</summary>
        public HapticLoop(FeelTip tip, double rate_Hz)
        {
            if (tip == null) throw new ArgumentNullException("tip");
            if (!(rate_Hz >= 100.0 && rate_Hz <= 4000.0)) throw new ArgumentOutOfRangeException("rate_Hz", rate_Hz, "not from 100 to 4000");
            this.tip = tip;
            this.rate_Hz = rate_Hz;
            Vibration = new VibrationStream(rate_Hz, 512);
            thread = new Thread(Run) { IsBackground = true, Name = "Asperity haptic loop", Priority = ThreadPriority.Highest };
        }

        /// <summary>Called on the loop's thread after each step; must not wait or allocate, but may Dispose. Set before Start.</summary>
        public Action<Touch> OnStep { get; set; }

        /// <summary>Below, a hand is pushed rather than vibrated, Hz.</summary>
        public const double LowestVibration_Hz = 30.0;

        /// <summary>The vibrating part of the force, for sound.</summary>
        public VibrationStream Vibration { get; private set; }

        public void Start() { thread.Start(); }

        /// <summary>The tip's centre in the scene's frame, m, now.</summary>
        public void SetTarget(Vector position_m)
        {
            lock (gate)
            {
                if (!track.Push(clock.Elapsed.TotalSeconds, position_m)) lifted = true;
            }
        }

        /// <summary>There is no position: the tip is lifted, and the force is zero from the next step on.</summary>
        public void Lift()
        {
            lock (gate)
            {
                track.Clear();
                lifted = true;
            }
        }

        /// <summary>The last step's result; without a force once the loop has ended.</summary>
        public Touch Last { get { lock (gate) return shared; } }

        /// <summary>From 0 to 1, how strongly a controller's motor should turn: RMS of the vibration above
        /// LowestVibration_Hz in the last 20 ms over `fullScale_N`. 0 while the hand rests or presses, and without a position.</summary>
        public double Rumble(double fullScale_N)
        {
            lock (gate) return Math.Min(1.0, rumble / fullScale_N);
        }

        public long Steps { get { lock (gate) return steps; } }

        /// <summary>Longest time between two steps since the last call, s.</summary>
        public double TakeLongestStep_s()
        {
            lock (gate)
            {
                double longest = longest_s;
                longest_s = 0.0;
                return longest;
            }
        }

        /// <summary>What ended the loop, or null.</summary>
        public Exception Fault { get { lock (gate) return fault; } }

        /// <summary>Ends the loop and waits for its last step; in OnStep it only asks for the end, which follows at once.</summary>
        public void Dispose()
        {
            if (Thread.CurrentThread == thread)
            {
                disposesItself = true;
                stop = true;
                return;
            }
            stop = true;
            if (thread.IsAlive) thread.Join();
            tip.Dispose();
        }

        private bool lifted;

        private void Run()
        {
            try { Loop(); }
            catch (Exception e)
            {
                lock (gate) fault = e;
            }
            lock (gate)
            {
                shared = Touch.Create();
                rumble = 0.0;
            }
            if (disposesItself) tip.Dispose();
        }

        private void Loop()
        {
            Motion motion = Motion.Create();
            Touch none = Touch.Create(), touch = none;
            double period_s = 1.0 / rate_Hz, next_s = clock.Elapsed.TotalSeconds, last_s = next_s - period_s;
            HighPass vibration = new HighPass(LowestVibration_Hz, rate_Hz);
            double square = 0.0, forget = Math.Exp(-period_s / 0.020);
            while (!stop)
            {
                double now_s = clock.Elapsed.TotalSeconds, took_s = now_s - last_s;
                last_s = now_s;
                bool has, reset;
                Vector position_m, velocity_mps;
                lock (gate)
                {
                    has = track.At(now_s, out position_m, out velocity_mps);
                    reset = lifted || !has;
                    lifted = false;
                }
                if (reset) tip.Reset();
                if (has)
                {
                    motion.Position_m = position_m;
                    motion.Velocity_mps = velocity_mps;
                    motion.Dt_s = took_s;
                    tip.Step(ref motion, ref touch);
                }
                else
                {
                    touch = none;
                }
                if (reset)
                {
                    vibration.StartAt(touch.Vibration_N);
                    Vibration.Interrupt();
                }
                double vibration_N = vibration.Push(touch.Vibration_N);
                square = has ? forget * square + (1.0 - forget) * vibration_N * vibration_N : 0.0;
                lock (gate)
                {
                    shared = touch;
                    rumble = Math.Sqrt(square);
                    longest_s = Math.Max(longest_s, took_s);
                    ++steps;
                }
                Vibration.Push(touch.Vibration_N);
                Action<Touch> then = OnStep;
                if (then != null) then(touch);
                // What is late is not caught up with: the next step is one period from now at the earliest.
                next_s = Math.Max(next_s + period_s, now_s);
                WaitUntil(next_s);
            }
        }

        // Sleeps are as long as the system's timer makes them, so the end of the wait yields.
        private void WaitUntil(double until_s)
        {
            while (!stop)
            {
                double left_s = until_s - clock.Elapsed.TotalSeconds;
                if (left_s <= 0.0) return;
                if (left_s > 0.002) Thread.Sleep(1);
                else Thread.Yield();
            }
        }
    }
}
