using System;
using UnityEngine;

namespace Asperity.Feel.Unity
{
    /// <summary>
    /// The tip of a stylus or a finger that touches one HapticSurface. Its GameObject's position is given to the haptic
    /// loop each frame; the force is rendered on the loop's thread. For a force-feedback device set OnForce, and keep its
    /// maker's limits: this package has none.
    /// </summary>
    [AddComponentMenu("Asperity/Haptic Tip")]
    public sealed class HapticTip : MonoBehaviour
    {
        public HapticSurface surface;
        [Tooltip("Of the tip, m; 0 is a point.")]
        [Range(0f, 0.02f)] public float tipRadius_m = 0.0005f;
        [Range(250f, 4000f)] public float rate_Hz = 1000f;
        [Tooltip("Shown at the surface while the tip is inside it.")]
        public Transform proxy;

        private HapticLoop loop;
        private HapticSurface of;

        /// <summary>
        /// Called on the loop's thread with the force in the scene's frame, N. Must not wait or allocate. Set before the
        /// component is enabled.
        /// </summary>
        public Action<Touch> OnForce { get; set; }

        /// <summary>The last step, in the scene's frame.</summary>
        public Touch Last { get { return loop == null ? Touch.Create() : loop.Last; } }

        /// <summary>Force on the hand in Unity's world, N.</summary>
        public Vector3 Force_N { get { return loop == null ? Vector3.zero : of.DirectionToWorld(loop.Last.Force_N); } }

        /// <summary>The vibrating part of the force; null while nothing is rendered.</summary>
        public VibrationStream Vibration { get { return loop == null ? null : loop.Vibration; } }

        /// <summary>From 0 to 1, for a controller's motor.</summary>
        public float Rumble(float fullScale_N) { return loop == null ? 0f : (float)loop.Rumble(fullScale_N); }

        private void OnDisable() { End(); }

        private void Update()
        {
            if (loop != null && (of != surface || surface == null || surface.Scene == null)) End();
            if (loop == null && !Begin()) return;
            if (loop.Fault != null)
            {
                Debug.LogError("Haptic Tip: the loop ended: " + loop.Fault.Message, this);
                End();
                enabled = false;
                return;
            }
            loop.SetTarget(of.ToScene(transform.position));
            if (proxy != null) proxy.position = loop.Last.IsTouching ? of.PointToWorld(loop.Last.Proxy_m) : transform.position;
        }

        // A program that is not in the foreground gets no positions; the loop's own time-out is the second line.
        private void OnApplicationPause(bool paused) { if (paused && loop != null) loop.Lift(); }
        private void OnApplicationFocus(bool focused) { if (!focused && loop != null) loop.Lift(); }

        private bool Begin()
        {
            if (surface == null || surface.Scene == null) return false;
            try
            {
                of = surface;
                loop = new HapticLoop(of.MakeTip(tipRadius_m, rate_Hz), rate_Hz) { OnStep = OnForce };
                loop.Start();
                return true;
            }
            catch (AsperityException e)
            {
                Debug.LogError("Haptic Tip '" + name + "': " + e.Message, this);
                enabled = false;
                return false;
            }
        }

        private void End()
        {
            if (loop != null) loop.Dispose();
            loop = null;
            of = null;
        }
    }
}
