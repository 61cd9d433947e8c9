using System;
using System.Runtime.InteropServices;

namespace Asperity.Feel
{
    /// <summary>Three numbers in the scene's frame (right-handed), in the unit that the name of the field states.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Vector
    {
        public double X, Y, Z;

        public Vector(double x, double y, double z) { X = x; Y = y; Z = z; }

        public double Length { get { return Math.Sqrt(X * X + Y * Y + Z * Z); } }
        public bool IsFinite
        {
            get
            {
                double sum = X + Y + Z;
                return !double.IsNaN(sum) && !double.IsInfinity(sum);
            }
        }

        public static Vector operator +(Vector a, Vector b) { return new Vector(a.X + b.X, a.Y + b.Y, a.Z + b.Z); }
        public static Vector operator -(Vector a, Vector b) { return new Vector(a.X - b.X, a.Y - b.Y, a.Z - b.Z); }
        public static Vector operator *(double s, Vector a) { return new Vector(s * a.X, s * a.Y, s * a.Z); }

        public override string ToString()
        {
            return string.Format(System.Globalization.CultureInfo.InvariantCulture, "({0:g6}, {1:g6}, {2:g6})", X, Y, Z);
        }
    }

    /// <summary>Input of a step (asperity_motion).</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Motion
    {
        private UIntPtr size;
        /// <summary>Centre of the tip, m.</summary>
        public Vector Position_m;
        /// <summary>Velocity of the tip's centre, m/s.</summary>
        public Vector Velocity_mps;
        /// <summary>Time since the step before, s.</summary>
        public double Dt_s;

        public static Motion Create() { return new Motion { size = Native.Count(Marshal.SizeOf(typeof(Motion))) }; }
    }

    /// <summary>Result of a step (asperity_touch).</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Touch
    {
        /// <summary>Value of Object and Triangle where nothing is touched.</summary>
        public const uint None = 0xFFFFFFFF;

        private UIntPtr size;
        /// <summary>Force on the hand, N: the sum of the next three.</summary>
        public Vector Force_N;
        public Vector Contact_N, Texture_N, Friction_N;
        /// <summary>Where the tip's centre would be on a rigid surface, m.</summary>
        public Vector Proxy_m;
        /// <summary>Height of the texture at the contact, m.</summary>
        public double TextureHeight_m;
        /// <summary>The part of the force that vibrates, N.</summary>
        public double Vibration_N;
        /// <summary>Point of the strongest contact on the surface, m, and the unit normal there.</summary>
        public Vector Point_m, Normal, Barycentric;
        public uint Object, Triangle;
        private int touching, sticking, startsInside;

        public bool IsTouching { get { return touching != 0; } }
        /// <summary>Friction holds the tip.</summary>
        public bool IsSticking { get { return sticking != 0; } }
        /// <summary>The tip started inside an object: no force until it has left it.</summary>
        public bool StartsInside { get { return startsInside != 0; } }

        public static Touch Create() { return new Touch { size = Native.Count(Marshal.SizeOf(typeof(Touch))), Object = None, Triangle = None }; }
    }
}
