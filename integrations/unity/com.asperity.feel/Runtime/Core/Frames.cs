namespace Asperity.Feel
{
    /// <summary>Which axis of the scene points up.</summary>
    public enum UpAxis { Z, Y }

    /// <summary>
    /// Between the scene's frame (right-handed, z or y up) and Unity's (left-handed, y up); both in metres. A reflection P
    /// maps vectors both ways: z up exchanges y and z, y up negates z. A rotation about the axis a by an angle becomes one
    /// about P a by its negative, so the vector part v of a quaternion becomes -P v.
    /// </summary>
    public static class Frames
    {
        public static Vector Map(Vector v, UpAxis up)
        {
            return up == UpAxis.Z ? new Vector(v.X, v.Z, v.Y) : new Vector(v.X, v.Y, -v.Z);
        }

        /// <summary>Both in the order w, x, y, z.</summary>
        public static double[] MapRotation(double[] wxyz, UpAxis up)
        {
            Vector v = Map(new Vector(wxyz[1], wxyz[2], wxyz[3]), up);
            return new[] { wxyz[0], -v.X, -v.Y, -v.Z };
        }
    }
}
