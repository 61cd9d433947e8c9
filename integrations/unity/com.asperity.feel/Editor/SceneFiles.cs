using System;
using System.Collections.Generic;
using System.IO;

namespace Asperity.Feel.Editor
{
    /// <summary>
    /// The files that a *.scene.json consists of: itself, what it names (meshes, textures, their map of what is covered,
    /// material maps), and what these name (a texture's image or table, a mesh's material library or buffers).
    /// </summary>
    public sealed class SceneFiles
    {
        private readonly string folder;
        private readonly SortedSet<string> names = new SortedSet<string>(StringComparer.Ordinal);

        private SceneFiles(string folder) { this.folder = folder; }

        /// <summary>
        /// Paths relative to the scene's folder, with slashes. Throws IOException for a name that leads out of the folder.
        /// </summary>
        public static IEnumerable<string> Of(string scene)
        {
            SceneFiles files = new SceneFiles(Path.GetDirectoryName(Path.GetFullPath(scene)));
            string name = Path.GetFileName(scene);
            files.names.Add(name);
            if (!name.EndsWith(".json", StringComparison.OrdinalIgnoreCase))
            {
                files.NamedByMesh(name);
                return files.names;
            }
            Dictionary<string, object> root = files.Json(name);
            files.Object(root, name);
            foreach (object other in List(root, "objects")) files.Object(other as Dictionary<string, object>, name);
            return files.names;
        }

        private void Object(Dictionary<string, object> of, string scene)
        {
            if (of == null) return;
            string mesh = Add(of, "mesh", "", scene);
            if (mesh != null) NamedByMesh(mesh);
            Add(of, "covered", "", scene);
            Add(of, "material", "", scene);
            foreach (object entry in List(of, "textures"))
            {
                string texture = Add(entry as Dictionary<string, object>, "file", "", scene);
                if (texture != null) NamedByTexture(texture);
            }
        }

        // The block of the texture's model may name an image or a table beside the texture.
        private void NamedByTexture(string texture)
        {
            Dictionary<string, object> root = Json(texture);
            object model, block;
            if (!root.TryGetValue("model", out model) || !(model is string) || !root.TryGetValue((string)model, out block)) return;
            Add(block as Dictionary<string, object>, "file", FolderOf(texture), texture);
        }

        private void NamedByMesh(string mesh)
        {
            string ending = Path.GetExtension(mesh).ToLowerInvariant();
            if (ending == ".gltf")
            {
                Dictionary<string, object> root = Json(mesh);
                foreach (object entry in List(root, "buffers")) AddUri(entry as Dictionary<string, object>, mesh, true);
                // Pictures are only seen: the scene is felt without them.
                foreach (object entry in List(root, "images")) AddUri(entry as Dictionary<string, object>, mesh, false);
            }
            if (ending != ".obj") return;
            foreach (string line in File.ReadLines(InFolder(mesh)))
            {
                if (!line.StartsWith("mtllib ", StringComparison.Ordinal)) continue;
                // One name with blanks in it, or several.
                string rest = line.Substring(7).Trim();
                List<string> libraries = new List<string>(rest.Split(' ', '\t')) { rest };
                foreach (string library in libraries)
                    if (library.Length > 0 && IsInside(library) && File.Exists(InFolder(FolderOf(mesh) + library))) Add(FolderOf(mesh) + library, mesh);
            }
        }

        private void AddUri(Dictionary<string, object> of, string mesh, bool needed)
        {
            object uri;
            if (of == null || !of.TryGetValue("uri", out uri) || !(uri is string)) return;
            string text = (string)uri;
            if (text.StartsWith("data:", StringComparison.OrdinalIgnoreCase)) return;
            string name = FolderOf(mesh) + Uri.UnescapeDataString(text);
            if (needed || (IsInside(name) && File.Exists(InFolder(name)))) Add(name, mesh);
        }

        // What `of` has under `key`, relative to `beside`; null if it has none.
        private string Add(Dictionary<string, object> of, string key, string beside, string namer)
        {
            object name;
            if (of == null || !of.TryGetValue(key, out name) || !(name is string)) return null;
            return Add(beside + (string)name, namer);
        }

        private string Add(string name, string namer)
        {
            if (!IsInside(name)) throw new IOException(InFolder(namer) + ": names '" + name + "', which is not in the scene's folder");
            if (!File.Exists(InFolder(name))) throw new IOException(InFolder(namer) + ": names '" + name + "', which is missing");
            if (IsBehindLink(name)) throw new IOException(InFolder(namer) + ": names '" + name + "', which is a link or behind one; copy the file into the folder");
            names.Add(name);
            return name;
        }

        // A link may lead out of the folder, to a file that is not the scene's.
        private bool IsBehindLink(string name)
        {
            for (string part = name; part.Length > 0; part = part.Substring(0, Math.Max(0, part.LastIndexOf('/'))))
                if ((File.GetAttributes(InFolder(part)) & FileAttributes.ReparsePoint) != 0) return true;
            return false;
        }

        private static bool IsInside(string name)
        {
            if (name.Length == 0 || name[0] == '/' || name.IndexOfAny(new[] { '\\', ':', '\0' }) >= 0) return false;
            foreach (string part in name.Split('/'))
                if (part == "." || part == ".." || part.Length == 0) return false;
            return true;
        }

        private string InFolder(string name) { return Path.Combine(folder, name); }

        // "" or "maps/".
        private static string FolderOf(string name) { return name.Substring(0, name.LastIndexOf('/') + 1); }

        private Dictionary<string, object> Json(string name)
        {
            Dictionary<string, object> root = JsonText.Parse(File.ReadAllText(InFolder(name)), InFolder(name)) as Dictionary<string, object>;
            if (root == null) throw new IOException(InFolder(name) + ": no object in braces");
            return root;
        }

        private static List<object> List(Dictionary<string, object> of, string key)
        {
            object list;
            return of.TryGetValue(key, out list) && list is List<object> ? (List<object>)list : new List<object>();
        }
    }
}
