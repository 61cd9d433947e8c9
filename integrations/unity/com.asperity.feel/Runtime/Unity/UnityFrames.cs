using UnityEngine;

namespace Asperity.Feel.Unity
{
    /// <summary>Frames for Unity's own types.</summary>
    public static class UnityFrames
    {
        public static Vector3 ToUnity(Vector v, UpAxis up)
        {
            Vector u = Frames.Map(v, up);
            return new Vector3((float)u.X, (float)u.Y, (float)u.Z);
        }

        public static Vector FromUnity(Vector3 v, UpAxis up) { return Frames.Map(new Vector(v.x, v.y, v.z), up); }

        /// <summary>`wxyz` of the scene.</summary>
        public static Quaternion ToUnity(double[] wxyz, UpAxis up)
        {
            double[] q = Frames.MapRotation(wxyz, up);
            return new Quaternion((float)q[1], (float)q[2], (float)q[3], (float)q[0]);
        }

        /// <summary>A mesh to show an object: in Unity's frame, so that triangles turn the other way round.</summary>
        public static Mesh ToUnity(double[] vertices_m, uint[] triangles, UpAxis up, string name)
        {
            Vector3[] points = new Vector3[vertices_m.Length / 3];
            for (int i = 0; i < points.Length; ++i)
                points[i] = ToUnity(new Vector(vertices_m[3 * i], vertices_m[3 * i + 1], vertices_m[3 * i + 2]), up);
            int[] corners = new int[triangles.Length];
            for (int i = 0; i + 2 < corners.Length; i += 3)
            {
                corners[i] = (int)triangles[i];
                corners[i + 1] = (int)triangles[i + 2];
                corners[i + 2] = (int)triangles[i + 1];
            }
            Mesh mesh = new Mesh { name = name, indexFormat = UnityEngine.Rendering.IndexFormat.UInt32 };
            mesh.vertices = points;
            mesh.triangles = corners;
            mesh.RecalculateNormals();
            mesh.RecalculateBounds();
            return mesh;
        }
    }
}
