using System.IO;
using UnityEngine;

namespace Asperity.Feel.Unity
{
    /// <summary>
    /// A scene of Asperity that HapticTips can touch. The GameObject's position and rotation place the scene's world frame;
    /// its scale must be 1, for a surface is measured in metres.
    /// </summary>
    [AddComponentMenu("Asperity/Haptic Surface")]
    [DisallowMultipleComponent]
    public sealed class HapticSurface : MonoBehaviour
    {
        [Tooltip("A *.scene.json or a mesh; relative paths begin in StreamingAssets.")]
        public string sceneFile = "";
        [Tooltip("Length of a mesh's unit, m, 0.001 for millimetres; 0: a metre. A *.scene.json states its own.")]
        public double meshUnit_m = 0.0;
        public UpAxis up = UpAxis.Z;
        [Tooltip("Where neither a material map nor a texture states it, N/m; 0: as the scene's file states it, or 1000.")]
        [Range(0f, 3000f)] public float stiffness_N_per_m = 0f;
        [Tooltip("Settings of the renderer, a NAME=VALUE each; `asperity feel --help` says where they are listed.")]
        public string[] settings = new string[0];
        [Tooltip("Shows the scene's objects with the material of this GameObject's MeshRenderer.")]
        public bool showMesh = true;

        private FeelScene scene;

        /// <summary>The scene that was read; null while the component is off or the file could not be read.</summary>
        public FeelScene Scene { get { return scene; } }

        private void OnEnable()
        {
            if (Vector3.Distance(transform.lossyScale, Vector3.one) > 1e-3f)
                Debug.LogWarning("Haptic Surface: the scale of '" + name + "' is not 1 and is left out of account.", this);
            string path = Path.IsPathRooted(sceneFile) ? sceneFile : Path.Combine(Application.streamingAssetsPath, sceneFile);
            try
            {
                scene = meshUnit_m > 0.0 ? FeelScene.Read(path, meshUnit_m) : FeelScene.Read(path);
                if (stiffness_N_per_m > 0f) scene.SetStiffness(stiffness_N_per_m);
                if (showMesh) ShowObjects();
            }
            catch (AsperityException e)
            {
                Debug.LogError("Haptic Surface '" + name + "': " + e.Message, this);
                Forget();
            }
            catch (System.DllNotFoundException)
            {
                Debug.LogError("Haptic Surface: the library asperity_feel is missing; see the package's README.", this);
            }
        }

        private void OnDisable() { Forget(); }

        /// <summary>A tip for this scene, with this component's settings.</summary>
        internal FeelTip MakeTip(double tipRadius_m, double rate_Hz)
        {
            using (FeelSettings of = new FeelSettings())
            {
                of.Set("tip_radius_m", tipRadius_m).Set("rate_Hz", rate_Hz);
                foreach (string setting in settings)
                {
                    int at = setting.IndexOf('=');
                    if (at <= 0) throw new AsperityException(Status.BadArgument, "setting '" + setting + "' is not NAME=VALUE");
                    of.Set(setting.Substring(0, at).Trim(), setting.Substring(at + 1).Trim());
                }
                return new FeelTip(scene, of);
            }
        }

        /// <summary>A point of Unity's world in the scene's frame, m.</summary>
        public Vector ToScene(Vector3 world)
        {
            return UnityFrames.FromUnity(Quaternion.Inverse(transform.rotation) * (world - transform.position), up);
        }

        /// <summary>A vector of the scene, such as a force, in Unity's world.</summary>
        public Vector3 DirectionToWorld(Vector v) { return transform.rotation * UnityFrames.ToUnity(v, up); }

        /// <summary>A point of the scene in Unity's world.</summary>
        public Vector3 PointToWorld(Vector p_m) { return transform.position + DirectionToWorld(p_m); }

        private void ShowObjects()
        {
            MeshRenderer own = GetComponent<MeshRenderer>();
            for (int i = 0; i < scene.ObjectCount; ++i)
            {
                double[] vertices_m, rotation_wxyz;
                uint[] triangles;
                Vector position_m;
                scene.Mesh(i, out vertices_m, out triangles);
                scene.Pose(i, out position_m, out rotation_wxyz);
                GameObject shown = new GameObject("object " + (i + 1));
                shown.hideFlags = HideFlags.DontSave;
                shown.transform.SetParent(transform, false);
                shown.transform.localPosition = UnityFrames.ToUnity(position_m, up);
                shown.transform.localRotation = UnityFrames.ToUnity(rotation_wxyz, up);
                shown.AddComponent<MeshFilter>().sharedMesh = UnityFrames.ToUnity(vertices_m, triangles, up, scene.ObjectName(i));
                MeshRenderer renderer = shown.AddComponent<MeshRenderer>();
                if (own != null) renderer.sharedMaterial = own.sharedMaterial;
            }
        }

        private void Forget()
        {
            for (int i = transform.childCount - 1; i >= 0; --i)
            {
                GameObject child = transform.GetChild(i).gameObject;
                if (child.hideFlags == HideFlags.DontSave) Destroy(child);
            }
            if (scene != null) scene.Dispose();
            scene = null;
        }
    }
}
