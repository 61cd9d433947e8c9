// The members of Unity's classes that the package uses, without function: the compiler checks the package's Unity part
// against them where there is no Unity. Signatures are those of Unity 2021.3's scripting reference.
using System;

namespace UnityEngine
{
    public class Object
    {
        public string name { get; set; }
        public HideFlags hideFlags { get; set; }
        public static void Destroy(Object o) { }
        public static bool operator ==(Object a, Object b) { return ReferenceEquals(a, b); }
        public static bool operator !=(Object a, Object b) { return !ReferenceEquals(a, b); }
        public override bool Equals(object o) { return ReferenceEquals(this, o); }
        public override int GetHashCode() { return 0; }
    }
    [Flags] public enum HideFlags { None = 0, DontSave = 52 }
    public class Component : Object
    {
        public Transform transform { get { return null; } }
        public GameObject gameObject { get { return null; } }
        public T GetComponent<T>() { return default(T); }
    }
    public class Behaviour : Component { public bool enabled { get; set; } }
    public class MonoBehaviour : Behaviour { }
    public class Transform : Component
    {
        public Vector3 position { get; set; }
        public Quaternion rotation { get; set; }
        public Vector3 localPosition { get; set; }
        public Quaternion localRotation { get; set; }
        public Vector3 localScale { get; set; }
        public Vector3 lossyScale { get { return Vector3.one; } }
        public int childCount { get { return 0; } }
        public Transform GetChild(int i) { return null; }
        public void SetParent(Transform parent, bool worldPositionStays) { }
    }
    public enum PrimitiveType { Sphere }
    public sealed class GameObject : Object
    {
        public GameObject(string name) { }
        public Transform transform { get { return null; } }
        public T AddComponent<T>() where T : Component { return null; }
        public T GetComponent<T>() { return default(T); }
        public void SetActive(bool on) { }
        public static GameObject CreatePrimitive(PrimitiveType type) { return null; }
    }
    public struct Vector3
    {
        public float x, y, z;
        public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
        public static Vector3 one { get { return new Vector3(1, 1, 1); } }
        public static Vector3 zero { get { return new Vector3(); } }
        public static float Distance(Vector3 a, Vector3 b) { return 0; }
        public static Vector3 operator +(Vector3 a, Vector3 b) { return a; }
        public static Vector3 operator -(Vector3 a, Vector3 b) { return a; }
        public static Vector3 operator *(float s, Vector3 a) { return a; }
    }
    public struct Vector2 { public float x, y; }
    public struct Quaternion
    {
        public float x, y, z, w;
        public Quaternion(float x, float y, float z, float w) { this.x = x; this.y = y; this.z = z; this.w = w; }
        public static Quaternion Inverse(Quaternion q) { return q; }
        public static Vector3 operator *(Quaternion q, Vector3 v) { return v; }
    }
    public struct Ray
    {
        public Vector3 origin { get; set; }
        public Vector3 direction { get; set; }
        public Vector3 GetPoint(float distance) { return origin; }
    }
    public static class Mathf
    {
        public static float Abs(float x) { return Math.Abs(x); }
        public static float Clamp(float x, float low, float high) { return x; }
    }
    public static class Input
    {
        public static Vector2 mouseScrollDelta { get { return new Vector2(); } }
        public static Vector3 mousePosition { get { return Vector3.zero; } }
    }
    public sealed class Camera : Behaviour
    {
        public static Camera main { get { return null; } }
        public Ray ScreenPointToRay(Vector3 p) { return new Ray(); }
    }
    public class Collider : Component { }
    public sealed class Mesh : Object
    {
        public UnityEngine.Rendering.IndexFormat indexFormat { get; set; }
        public Vector3[] vertices { get; set; }
        public int[] triangles { get; set; }
        public void RecalculateNormals() { }
        public void RecalculateBounds() { }
    }
    public sealed class MeshFilter : Component { public Mesh sharedMesh { get; set; } }
    public class Material : Object { }
    public class Renderer : Component { public Material sharedMaterial { get; set; } }
    public sealed class MeshRenderer : Renderer { }
    public sealed class LineRenderer : Renderer
    {
        public int positionCount { get; set; }
        public float startWidth { get; set; }
        public float endWidth { get; set; }
        public void SetPosition(int i, Vector3 p) { }
    }
    public sealed class AudioSource : Behaviour { public void Play() { } }
    public static class AudioSettings { public static int outputSampleRate { get { return 48000; } } }
    public static class Application { public static string streamingAssetsPath { get { return ""; } } }
    public static class Debug
    {
        public static void LogError(object message, Object context) { }
        public static void LogWarning(object message, Object context) { }
    }
    [AttributeUsage(AttributeTargets.Class)] public sealed class AddComponentMenu : Attribute { public AddComponentMenu(string menu) { } }
    [AttributeUsage(AttributeTargets.Class)] public sealed class DisallowMultipleComponent : Attribute { }
    [AttributeUsage(AttributeTargets.Class)] public sealed class RequireComponent : Attribute { public RequireComponent(Type t) { } }
    [AttributeUsage(AttributeTargets.Field)] public sealed class TooltipAttribute : Attribute { public TooltipAttribute(string text) { } }
    [AttributeUsage(AttributeTargets.Field)] public sealed class RangeAttribute : Attribute { public RangeAttribute(float low, float high) { } }
}

namespace UnityEngine.Rendering
{
    public enum IndexFormat { UInt16, UInt32 }
}

namespace UnityEngine.XR
{
    public enum XRNode { LeftHand = 4, RightHand = 5 }
    public struct InputDevice
    {
        public bool isValid { get { return false; } }
        public bool SendHapticImpulse(uint channel, float amplitude, float duration) { return false; }
    }
    public static class InputDevices { public static InputDevice GetDeviceAtXRNode(XRNode node) { return new InputDevice(); } }
}

namespace UnityEditor
{
    [AttributeUsage(AttributeTargets.Method)] public sealed class MenuItem : Attribute { public MenuItem(string item) { } }
    public static class EditorUtility
    {
        public static string OpenFilePanel(string title, string folder, string extension) { return null; }
        public static bool DisplayDialog(string title, string message, string ok) { return true; }
    }
    public static class AssetDatabase { public static void Refresh() { } }
    public static class Undo { public static void RegisterCreatedObjectUndo(UnityEngine.Object o, string name) { } }
    public static class Selection { public static UnityEngine.GameObject activeGameObject { get; set; } }
}
