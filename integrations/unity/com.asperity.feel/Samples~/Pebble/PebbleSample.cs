using Asperity.Feel.Unity;
using UnityEngine;

namespace Asperity.Feel.Samples
{
    /// <summary>
    /// Put on an empty GameObject and press Play: a pebble of 60 mm, a stylus that the mouse moves (the wheel raises and
    /// lowers it), the force as a line, the vibration as sound and as the rumble of the right controller.
    /// Copy the sample's folder `pebble` to StreamingAssets first.
    /// </summary>
    public sealed class PebbleSample : MonoBehaviour
    {
        public string sceneFile = "pebble/scene.json";

        private HapticTip tip;
        private LineRenderer force;
        private float height_m = 0.05f;

        private void Start()
        {
            GameObject pebble = Make("pebble", PrimitiveType.Sphere, 0f);
            pebble.SetActive(false);  // a surface reads its file when it is enabled
            HapticSurface surface = pebble.AddComponent<HapticSurface>();
            surface.sceneFile = sceneFile;
            surface.settings = new[] { "friction=0.3" };
            pebble.SetActive(true);

            GameObject stylus = Make("stylus", PrimitiveType.Sphere, 0.004f);
            tip = stylus.AddComponent<HapticTip>();
            tip.surface = surface;
            tip.proxy = Make("where it touches", PrimitiveType.Sphere, 0.003f).transform;
            HapticSound sound = stylus.AddComponent<HapticSound>();
            sound.tip = tip;
            stylus.AddComponent<HapticRumble>().tip = tip;
            force = stylus.AddComponent<LineRenderer>();
            force.positionCount = 2;
            force.startWidth = force.endWidth = 0.0008f;
        }

        private void Update()
        {
            Camera eye = Camera.main;
            if (eye == null) return;
            height_m = Mathf.Clamp(height_m - 0.002f * Input.mouseScrollDelta.y, 0f, 0.08f);
            // Where the mouse's ray meets the plane of the tip's height.
            Ray ray = eye.ScreenPointToRay(Input.mousePosition);
            if (Mathf.Abs(ray.direction.y) < 1e-4f) return;
            tip.transform.position = ray.GetPoint((height_m - ray.origin.y) / ray.direction.y);
            force.SetPosition(0, tip.transform.position);
            force.SetPosition(1, tip.transform.position + 0.02f * tip.Force_N);  // 20 mm a newton
        }

        private static GameObject Make(string name, PrimitiveType type, float size_m)
        {
            GameObject made = GameObject.CreatePrimitive(type);
            made.name = name;
            Destroy(made.GetComponent<Collider>());
            if (size_m > 0f) made.transform.localScale = size_m * Vector3.one;
            else Destroy(made.GetComponent<MeshFilter>());
            return made;
        }
    }
}
