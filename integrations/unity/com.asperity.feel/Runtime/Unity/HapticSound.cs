using UnityEngine;

namespace Asperity.Feel.Unity
{
    /// <summary>
    /// Plays a tip's vibration through this GameObject's AudioSource: to a voice coil at a sound card, or to be heard. Use
    /// an AudioSource without a clip, spatial blend 0.
    /// </summary>
    [AddComponentMenu("Asperity/Haptic Sound")]
    [RequireComponent(typeof(AudioSource))]
    public sealed class HapticSound : MonoBehaviour
    {
        public HapticTip tip;
        [Range(0f, 1f)] public float volume = 0.5f;
        [Tooltip("The vibration that is the loudest, N.")]
        [Range(0.01f, 5f)] public float fullScale_N = 0.5f;

        private volatile VibrationStream stream;  // read by the audio thread
        private double sampleRate_Hz = 48000.0;

        private void OnEnable()
        {
            sampleRate_Hz = AudioSettings.outputSampleRate;
            GetComponent<AudioSource>().Play();
        }

        private void OnDisable() { stream = null; }

        private void Update() { stream = tip == null ? null : tip.Vibration; }

        private void OnAudioFilterRead(float[] data, int channels)
        {
            VibrationStream of = stream;
            if (of != null) of.Fill(data, channels, sampleRate_Hz, volume, fullScale_N);
        }
    }
}
