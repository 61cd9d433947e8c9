using System;

namespace Asperity.Feel
{
    /// <summary>
    /// Objects with textures and materials (asperity_scene). Lengths in metres, in the scene's world frame, which is
    /// right-handed. For one thread at a time; a tip that was made of it does not need it any more.
    /// </summary>
    public sealed class FeelScene : IDisposable
    {
        internal readonly SceneHandle Handle;

        private FeelScene(IntPtr scene) { Handle = new SceneHandle(scene); }

        /// <summary>Version of the C library, such as "1.2 (asperity 0.2.0)".</summary>
        public static string LibraryVersion { get { return Native.Text(Native.asperity_feel_version()); } }

        /// <summary>Reads a *.scene.json with the files that it names, or a mesh (OBJ, PLY, STL, OFF, glTF) in metres. A mesh
        /// that would be larger than 5 m or smaller than 1 mm is refused: its unit is to be stated.</summary>
        public static FeelScene Read(string path)
        {
            IntPtr scene;
            Native.Check(Native.asperity_scene_read(Native.Utf8(path), out scene));
            return new FeelScene(scene);
        }

        /// <summary>The same of a mesh whose unit has a length of `unit_m`, 0.001 for millimetres.</summary>
        public static FeelScene Read(string path, double unit_m)
        {
            IntPtr scene;
            Native.Check(Native.asperity_scene_read_with_unit(Native.Utf8(path), unit_m, out scene));
            return new FeelScene(scene);
        }

        /// <summary>One object of x, y, z per vertex and three indices per triangle, counter-clockwise seen from outside.</summary>
        public static FeelScene FromMesh(double[] vertices_m, uint[] triangles)
        {
            if (vertices_m == null) throw new ArgumentNullException("vertices_m");
            if (triangles == null) throw new ArgumentNullException("triangles");
            if (vertices_m.Length % 3 != 0) throw new ArgumentException("vertices_m has " + vertices_m.Length + " numbers, not three per vertex");
            if (triangles.Length % 3 != 0) throw new ArgumentException("triangles has " + triangles.Length + " indices, not three per triangle");
            IntPtr scene;
            Native.Check(Native.asperity_scene_from_mesh(vertices_m, Native.Count(vertices_m.Length / 3), triangles,
                                                         Native.Count(triangles.Length / 3), out scene));
            return new FeelScene(scene);
        }

        public int ObjectCount { get { return (int)Native.asperity_scene_object_count(Handle).ToUInt64(); } }

        /// <summary>File of the object's mesh, "" for one of FromMesh.</summary>
        public string ObjectName(int index)
        {
            Within(index);
            return Native.Text(Native.asperity_scene_object_name(Handle, Native.Count(index)));
        }

        /// <summary>The object's mesh in its own frame, to show it.</summary>
        public void Mesh(int index, out double[] vertices_m, out uint[] triangles)
        {
            Within(index);
            UIntPtr vertices, corners;
            Native.Check(Native.asperity_scene_mesh(Handle, Native.Count(index), null, UIntPtr.Zero, out vertices, null, UIntPtr.Zero, out corners));
            vertices_m = new double[checked((int)(3 * vertices.ToUInt64()))];
            triangles = new uint[checked((int)(3 * corners.ToUInt64()))];
            Native.Check(Native.asperity_scene_mesh(Handle, Native.Count(index), vertices_m, vertices, out vertices, triangles, corners, out corners));
        }

        /// <summary>The object's origin and its orientation (w, x, y, z) in the scene's world frame.</summary>
        public void Pose(int index, out Vector position_m, out double[] rotation_wxyz)
        {
            Within(index);
            double[] at = new double[3];
            rotation_wxyz = new double[4];
            Native.Check(Native.asperity_scene_pose(Handle, Native.Count(index), at, rotation_wxyz));
            position_m = new Vector(at[0], at[1], at[2]);
        }

        public void SetPose(int index, Vector position_m, double[] rotation_wxyz)
        {
            Within(index);
            if (rotation_wxyz == null || rotation_wxyz.Length != 4) throw new ArgumentException("rotation_wxyz has not four numbers");
            Native.Check(Native.asperity_scene_set_pose(Handle, Native.Count(index), new[] { position_m.X, position_m.Y, position_m.Z }, rotation_wxyz));
        }

        /// <summary>
        /// Paints a *.texture.json along the path through the surface's points nearest to `points_m` (x, y, z each, in the
        /// mesh's frame), within `halfWidth_m` of it. A texture of the same index of this object is replaced.
        /// </summary>
        public void Paint(int index, string texturePath, double[] points_m, double halfWidth_m, int textureIndex)
        {
            Within(index);
            if (points_m == null || points_m.Length % 3 != 0) throw new ArgumentException("points_m has not three numbers per point");
            Native.Check(Native.asperity_scene_paint(Handle, Native.Count(index), Native.Utf8(texturePath), points_m,
                                                     Native.Count(points_m.Length / 3), halfWidth_m, textureIndex));
        }

        /// <summary>Replaces the texture of that index of the first object.</summary>
        public void SetTexture(int textureIndex, string texturePath)
        {
            Native.Check(Native.asperity_scene_set_texture(Handle, textureIndex, Native.Utf8(texturePath)));
        }

        /// <summary>Where neither a material map nor a texture states it, N/m.</summary>
        public void SetStiffness(double stiffness_N_per_m)
        {
            Native.Check(Native.asperity_scene_set_stiffness(Handle, stiffness_N_per_m));
        }

        /// <summary>Coefficient of sliding friction, and the static coefficient over it (at least 1).</summary>
        public void SetFriction(double sliding, double staticRatio)
        {
            Native.Check(Native.asperity_scene_set_friction(Handle, sliding, staticRatio));
        }

        public void Dispose() { Handle.Dispose(); }

        private void Within(int index)
        {
            if (index < 0 || index >= ObjectCount) throw new ArgumentOutOfRangeException("index", index, "the scene has " + ObjectCount + " objects");
        }
    }
}
