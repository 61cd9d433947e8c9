using UnityEngine;
using UnityEngine.XR;

namespace Asperity.Feel.Unity
{
    /// <summary>
    /// Gives a tip's vibration to the motor of an OpenXR controller: one impulse a frame, as strong as the vibration of the
    /// last 20 ms. A motor keeps the roughness, not the texture's waves; where a controller takes a buffer of samples, use
    /// HapticSound with its audio device instead.
    /// </summary>
    [AddComponentMenu("Asperity/Haptic Rumble")]
    public sealed class HapticRumble : MonoBehaviour
    {
        public HapticTip tip;
        public XRNode hand = XRNode.RightHand;
        [Tooltip("The vibration that is the strongest, N.")]
        [Range(0.01f, 5f)] public float fullScale_N = 0.5f;

        private const float Longest_s = 0.05f;  // without a further frame the motor stops by itself

        private void Update()
        {
            if (tip == null) return;
            float strength = tip.Rumble(fullScale_N);
            if (strength < 0.01f) return;
            InputDevice device = InputDevices.GetDeviceAtXRNode(hand);
            if (device.isValid) device.SendHapticImpulse(0, strength, Longest_s);
        }
    }
}
