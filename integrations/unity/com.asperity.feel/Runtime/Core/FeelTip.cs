using System;

namespace Asperity.Feel
{
    /// <summary>
    /// One tip with its state from step to step (asperity_feel). Step, Steps and Reset are for one thread at a time;
    /// Update may come from another thread. A step allocates nothing.
    /// </summary>
    public sealed class FeelTip : IDisposable
    {
        private readonly TipHandle handle;

        /// <summary>`settings` may be null: the defaults.</summary>
        public FeelTip(FeelScene scene, FeelSettings settings)
        {
            if (scene == null) throw new ArgumentNullException("scene");
            IntPtr feel;
            using (FeelSettings defaults = settings == null ? new FeelSettings() : null)
            {
                Native.Check(Native.asperity_feel_create(scene.Handle, (settings ?? defaults).Handle, out feel));
            }
            handle = new TipHandle(feel);
        }

        /// <summary>One step of the loop. A motion that is not finite gives a force of zero.</summary>
        public void Step(ref Motion motion, ref Touch touch)
        {
            if (handle.IsClosed) throw new ObjectDisposedException("FeelTip");
            int status = Native.asperity_feel_step(handle.Pointer, ref motion, ref touch);
            GC.KeepAlive(this);
            if (status != 0) throw new ArgumentException("a Motion or Touch that Create() did not make");
        }

        /// <summary>motions[i] gives touches[i], one after the other; touches[0] must come from Touch.Create().</summary>
        public void Steps(Motion[] motions, Touch[] touches)
        {
            if (handle.IsClosed) throw new ObjectDisposedException("FeelTip");
            if (motions == null) throw new ArgumentNullException("motions");
            if (touches == null || touches.Length < motions.Length) throw new ArgumentException("fewer touches than motions");
            if (motions.Length == 0) return;
            int status = Native.asperity_feel_steps(handle.Pointer, motions, touches, Native.Count(motions.Length));
            GC.KeepAlive(this);
            if (status != 0) throw new ArgumentException("a Motion or Touch that Create() did not make");
        }

        /// <summary>From the next step on, this scene. Materials and textures change gradually, meshes and poses at once.</summary>
        public void Update(FeelScene scene, FeelSettings settings)
        {
            if (scene == null) throw new ArgumentNullException("scene");
            using (FeelSettings defaults = settings == null ? new FeelSettings() : null)
            {
                Native.Check(Native.asperity_feel_update(handle, scene.Handle, (settings ?? defaults).Handle));
            }
        }

        /// <summary>The tip was lifted and set down elsewhere.</summary>
        public void Reset()
        {
            if (handle.IsClosed) throw new ObjectDisposedException("FeelTip");
            Native.asperity_feel_reset(handle.Pointer);
            GC.KeepAlive(this);
        }

        public void Dispose() { handle.Dispose(); }
    }
}
