using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Asperity.Feel
{
    /// <summary>Result codes of the C library (asperity_status).</summary>
    public enum Status
    {
        Ok = 0,
        BadArgument = 1,
        BadFile = 2,
        NoMemory = 3,
        Internal = 4
    }

    /// <summary>A call of the library failed; the message is the library's own.</summary>
    public sealed class AsperityException : Exception
    {
        public AsperityException(Status status, string message) : base(message) { Status = status; }

        public Status Status { get; }
    }

    /// <summary>The functions of asperity_feel.h, version 1.2, as they are.</summary>
    internal static class Native
    {
        private const string Library = "asperity_feel";

        [DllImport(Library)] internal static extern IntPtr asperity_status_text(int status);
        [DllImport(Library)] internal static extern IntPtr asperity_last_error();
        [DllImport(Library)] internal static extern IntPtr asperity_feel_version();

        [DllImport(Library)] internal static extern int asperity_scene_read(byte[] path, out IntPtr scene);
        [DllImport(Library)]
        internal static extern int asperity_scene_read_with_unit(byte[] path, double unit_m, out IntPtr scene);
        [DllImport(Library)]
        internal static extern int asperity_scene_from_mesh(double[] vertices_m, UIntPtr vertexCount, uint[] triangles,
                                                            UIntPtr triangleCount, out IntPtr scene);
        [DllImport(Library)] internal static extern void asperity_scene_free(IntPtr scene);
        [DllImport(Library)] internal static extern UIntPtr asperity_scene_object_count(SceneHandle scene);
        [DllImport(Library)] internal static extern IntPtr asperity_scene_object_name(SceneHandle scene, UIntPtr index);
        [DllImport(Library)]
        internal static extern int asperity_scene_mesh(SceneHandle scene, UIntPtr index, double[] vertices_m,
                                                       UIntPtr vertexCapacity, out UIntPtr vertexCount, uint[] triangles,
                                                       UIntPtr triangleCapacity, out UIntPtr triangleCount);
        [DllImport(Library)]
        internal static extern int asperity_scene_pose(SceneHandle scene, UIntPtr index, double[] position_m,
                                                       double[] rotation_wxyz);
        [DllImport(Library)]
        internal static extern int asperity_scene_set_pose(SceneHandle scene, UIntPtr index, double[] position_m,
                                                           double[] rotation_wxyz);
        [DllImport(Library)]
        internal static extern int asperity_scene_paint(SceneHandle scene, UIntPtr index, byte[] texturePath,
                                                        double[] points_m, UIntPtr pointCount, double halfWidth_m,
                                                        int textureIndex);
        [DllImport(Library)]
        internal static extern int asperity_scene_set_texture(SceneHandle scene, int textureIndex, byte[] texturePath);
        [DllImport(Library)]
        internal static extern int asperity_scene_set_stiffness(SceneHandle scene, double stiffness_N_per_m);
        [DllImport(Library)]
        internal static extern int asperity_scene_set_friction(SceneHandle scene, double sliding, double staticRatio);

        [DllImport(Library)] internal static extern int asperity_settings_create(out IntPtr settings);
        [DllImport(Library)] internal static extern void asperity_settings_free(IntPtr settings);
        [DllImport(Library)]
        internal static extern int asperity_settings_set(SettingsHandle settings, byte[] name, byte[] value);
        [DllImport(Library)] internal static extern UIntPtr asperity_settings_count();
        [DllImport(Library)] internal static extern IntPtr asperity_settings_name(UIntPtr setting);
        [DllImport(Library)] internal static extern IntPtr asperity_settings_help(UIntPtr setting);

        [DllImport(Library)]
        internal static extern int asperity_feel_create(SceneHandle scene, SettingsHandle settings, out IntPtr feel);
        [DllImport(Library)] internal static extern void asperity_feel_free(IntPtr feel);
        [DllImport(Library)]
        internal static extern int asperity_feel_update(TipHandle feel, SceneHandle scene, SettingsHandle settings);
        // These four are called at the rate of the haptic loop, so the handle goes as it is (HapticLoop holds it).
        [DllImport(Library)] internal static extern int asperity_feel_step(IntPtr feel, ref Motion motion, ref Touch touch);
        [DllImport(Library)]
        internal static extern int asperity_feel_steps(IntPtr feel, [In] Motion[] motions, [In, Out] Touch[] touches,
                                                       UIntPtr count);
        [DllImport(Library)] internal static extern void asperity_feel_reset(IntPtr feel);
        [DllImport(Library)]
        internal static extern double asperity_vibration_rumble(double[] force_N, UIntPtr count, double fullScale_N);

        [DllImport(Library)]
        internal static extern int asperity_vibration_samples(double[] force_N, UIntPtr count, double forceRate_Hz,
                                                              double sampleRate_Hz, double volume, double fullScale_N,
                                                              float[] samples, UIntPtr capacity, out UIntPtr written);

        internal static UIntPtr Count(long n) { return new UIntPtr((ulong)n); }

        internal static byte[] Utf8(string text)
        {
            if (text == null) throw new ArgumentNullException("text");
            if (text.IndexOf('\0') >= 0) throw new ArgumentException("a text with a zero character: " + text.Replace("\0", "\\0"));
            return Encoding.UTF8.GetBytes(text + "\0");
        }

        internal static string Text(IntPtr utf8)
        {
            if (utf8 == IntPtr.Zero) return null;
            int length = 0;
            while (Marshal.ReadByte(utf8, length) != 0) ++length;
            byte[] bytes = new byte[length];
            Marshal.Copy(utf8, bytes, 0, length);
            return Encoding.UTF8.GetString(bytes);
        }

        internal static void Check(int status)
        {
            if (status == (int)Status.Ok) return;
            string why = Text(asperity_last_error());
            if (string.IsNullOrEmpty(why)) why = Text(asperity_status_text(status));
            throw new AsperityException((Status)status, why.Replace("asperity_scene_read_with_unit()", "FeelScene.Read(path, unit_m)"));
        }
    }

    internal sealed class SceneHandle : SafeHandle
    {
        public SceneHandle() : base(IntPtr.Zero, true) { }
        internal SceneHandle(IntPtr scene) : this() { SetHandle(scene); }
        public override bool IsInvalid { get { return handle == IntPtr.Zero; } }
        protected override bool ReleaseHandle() { Native.asperity_scene_free(handle); return true; }
    }

    internal sealed class SettingsHandle : SafeHandle
    {
        public SettingsHandle() : base(IntPtr.Zero, true) { }
        internal SettingsHandle(IntPtr settings) : this() { SetHandle(settings); }
        public override bool IsInvalid { get { return handle == IntPtr.Zero; } }
        protected override bool ReleaseHandle() { Native.asperity_settings_free(handle); return true; }
    }

    internal sealed class TipHandle : SafeHandle
    {
        public TipHandle() : base(IntPtr.Zero, true) { }
        internal TipHandle(IntPtr feel) : this() { SetHandle(feel); }
        public override bool IsInvalid { get { return handle == IntPtr.Zero; } }
        internal IntPtr Pointer { get { return handle; } }
        protected override bool ReleaseHandle() { Native.asperity_feel_free(handle); return true; }
    }
}
