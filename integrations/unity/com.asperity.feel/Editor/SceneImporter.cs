using System;
using System.IO;
using Asperity.Feel.Unity;
using UnityEditor;
using UnityEngine;

namespace Asperity.Feel.Editor
{
    /// <summary>
    /// Assets / Import Asperity scene: copies a *.scene.json and the files that it names into a folder of
    /// StreamingAssets/Asperity, and makes a GameObject with a HapticSurface of it.
    /// </summary>
    public static class SceneImporter
    {
        [MenuItem("Assets/Import Asperity scene...")]
        public static void Import()
        {
            string file = EditorUtility.OpenFilePanel("Asperity scene", "", "json");
            if (string.IsNullOrEmpty(file)) return;
            try
            {
                string copy = CopyScene(file, Application.streamingAssetsPath);
                AssetDatabase.Refresh();
                GameObject made = new GameObject(Path.GetFileNameWithoutExtension(Path.GetFileNameWithoutExtension(file)));
                made.AddComponent<MeshRenderer>();
                made.AddComponent<HapticSurface>().sceneFile = copy;
                Undo.RegisterCreatedObjectUndo(made, "Import Asperity scene");
                Selection.activeGameObject = made;
            }
            catch (Exception e)
            {
                EditorUtility.DisplayDialog("Asperity scene", e.Message, "Close");
            }
        }

        /// <summary>
        /// Checks that the scene can be read, copies it with its files below `into`, and returns the copy's path relative
        /// to that. A folder that is there already is not changed: the copy gets a number.
        /// </summary>
        public static string CopyScene(string file, string into)
        {
            using (FeelScene read = FeelScene.Read(file))
            {
                if (read.ObjectCount == 0) throw new IOException(file + ": the scene has no object");
            }
            string from = Path.GetDirectoryName(Path.GetFullPath(file)), name = Path.GetFileName(from);
            string target = Path.Combine(into, "Asperity", name);
            for (int i = 2; Directory.Exists(target); ++i) target = Path.Combine(into, "Asperity", name + " " + i);
            string partly = target + ".partly";
            if (Directory.Exists(partly)) Directory.Delete(partly, true);
            foreach (string each in SceneFiles.Of(file)) CopyFile(from, partly, each);
            Directory.Move(partly, target);
            return Path.Combine("Asperity", Path.GetFileName(target), Path.GetFileName(file)).Replace('\\', '/');
        }

        private static void CopyFile(string from, string to, string name)
        {
            string copy = Path.Combine(to, name);
            Directory.CreateDirectory(Path.GetDirectoryName(copy));
            File.Copy(Path.Combine(from, name), copy);
        }
    }
}
