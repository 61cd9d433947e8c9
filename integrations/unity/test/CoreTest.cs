// The package's part without Unity, over the C library: CoreTest.exe SCENE FOLDER
using System;
using System.Collections.Generic;
using System.IO;
using System.Runtime.InteropServices;
using System.Threading;
using Asperity.Feel;

internal static class CoreTest
{
    private static int failed, checks;

    private static void Expect(bool holds, string what)
    {
        ++checks;
        if (holds) return;
        ++failed;
        Console.Error.WriteLine("failed: " + what);
    }

    private static void Near(double value, double expected, double tolerance, string what)
    {
        Expect(Math.Abs(value - expected) <= tolerance, what + ": " + value + ", expected " + expected + " ± " + tolerance);
    }

    private static void Throws<T>(Action act, string message) where T : Exception
    {
        try { act(); }
        catch (T e) { Expect(e.Message.Contains(message), "'" + e.Message + "' has '" + message + "'"); return; }
        Expect(false, "no " + typeof(T).Name + " with '" + message + "'");
    }

    private static FeelScene Plate()
    {
        return FeelScene.FromMesh(new[] { 0, 0, 0, 0.06, 0, 0, 0.06, 0.02, 0, 0, 0.02, 0 }, new uint[] { 0, 1, 2, 0, 2, 3 });
    }

    private static void LayoutIsThatOfTheHeader()
    {
        Near(Marshal.SizeOf(typeof(Motion)), 64, 0, "size of Motion");
        Near(Marshal.SizeOf(typeof(Touch)), 240, 0, "size of Touch");
        Near((long)Marshal.OffsetOf(typeof(Touch), "Vibration_N"), 136, 0, "offset of Vibration_N");
        Near((long)Marshal.OffsetOf(typeof(Touch), "Object"), 216, 0, "offset of Object");
        Expect(FeelScene.LibraryVersion.StartsWith("1.2 "), "version " + FeelScene.LibraryVersion);
    }

    // 500 N/m (the default of the settings is asked for) by 1 mm.
    private static void APlateIsFelt()
    {
        using (FeelScene plate = Plate())
        {
            plate.SetStiffness(500.0);
            plate.SetFriction(0.0, 1.0);
            using (FeelTip tip = new FeelTip(plate, null))
            {
                Motion motion = Motion.Create();
                Touch touch = Touch.Create();
                motion.Dt_s = 1e-3;
                for (int i = 0; i <= 100; ++i)
                {
                    motion.Position_m = new Vector(0.01, 0.01, 1e-3 - 2e-5 * i);
                    tip.Step(ref motion, ref touch);
                }
                Near(touch.Force_N.Z, 0.5, 1e-9, "force 1 mm deep");
                Expect(touch.IsTouching && touch.Object == 0 && !touch.StartsInside, "it touches object 0");
                Near(touch.Normal.Z, 1.0, 1e-12, "normal");

                Motion[] motions = new Motion[100];
                Touch[] touches = new Touch[100];
                for (int i = 0; i < 100; ++i)
                {
                    motions[i] = Motion.Create();
                    motions[i].Position_m = new Vector(0.01 + 1e-5 * i, 0.01, -1e-3);
                    motions[i].Dt_s = 1e-3;
                    touches[i] = Touch.Create();
                }
                tip.Steps(motions, touches);
                Near(touches[99].Force_N.Z, 0.5, 1e-9, "force after 100 steps at once");
                Throws<ArgumentException>(() => tip.Steps(motions, new Touch[3]), "fewer touches");
                motion = new Motion();
                Throws<ArgumentException>(() => tip.Step(ref motion, ref touch), "Create()");
                tip.Dispose();
                Throws<ObjectDisposedException>(() => tip.Reset(), "FeelTip");
            }
        }
    }

    private static void ErrorsAreExceptions()
    {
        Throws<AsperityException>(() => FeelScene.Read("no/such.scene.json"), "no/such.scene.json");
        Throws<ArgumentException>(() => FeelScene.Read("a\0b"), "zero character");
        Throws<AsperityException>(() => FeelScene.FromMesh(new double[9], new uint[] { 0, 1, 3 }), "index 3");
        Throws<ArgumentException>(() => FeelScene.FromMesh(new double[8], new uint[3]), "8 numbers");
        string inMillimetres = Path.GetTempFileName() + ".obj";
        File.WriteAllText(inMillimetres, "v 0 0 0\nv 60 0 0\nv 0 20 0\nf 1 2 3\n");
        Throws<AsperityException>(() => FeelScene.Read(inMillimetres), "63.2 m large if its unit is a metre; state its unit: FeelScene.Read(path, unit_m)");
        using (FeelScene small = FeelScene.Read(inMillimetres, 1e-3)) Expect(small.ObjectCount == 1, "its unit is stated");
        File.Delete(inMillimetres);
        using (FeelSettings settings = new FeelSettings())
        {
            Throws<AsperityException>(() => settings.Set("fiction", 0.3), "friction");
        }
        using (FeelScene plate = Plate())
        {
            Throws<ArgumentOutOfRangeException>(() => plate.ObjectName(1), "1 objects");
            Throws<AsperityException>(() => plate.SetStiffness(-1.0), "stiffness");
        }
        int named = 0;
        foreach (KeyValuePair<string, string> setting in FeelSettings.All) named += setting.Key.Length > 0 && setting.Value.Length > 0 ? 1 : 0;
        Expect(named > 10, "settings have names and meanings: " + named);
    }

    private static void ASceneIsReadShownAndFelt(string file)
    {
        using (FeelScene scene = FeelScene.Read(file))
        {
            Expect(scene.ObjectCount >= 1, "objects");
            double[] vertices_m, rotation;
            uint[] triangles;
            Vector position_m;
            scene.Mesh(0, out vertices_m, out triangles);
            scene.Pose(0, out position_m, out rotation);
            Expect(vertices_m.Length > 100 && triangles.Length > 100, "the mesh is given back");
            Near(rotation[0], 1.0, 1e-12, "its orientation");
            Vector high = new Vector(0, 0, double.NegativeInfinity), low = new Vector(0, 0, double.PositiveInfinity);
            for (int i = 0; i < vertices_m.Length; i += 3)
            {
                if (vertices_m[i + 2] > high.Z) high = new Vector(vertices_m[i], vertices_m[i + 1], vertices_m[i + 2]);
                if (vertices_m[i + 2] < low.Z) low = new Vector(vertices_m[i], vertices_m[i + 1], vertices_m[i + 2]);
            }
            using (FeelSettings settings = new FeelSettings().Set("tip_radius_m", 0.0005))
            using (FeelTip tip = new FeelTip(scene, settings))
            {
                Motion motion = Motion.Create();
                Touch touch = Touch.Create();
                motion.Dt_s = 1e-3;
                double most_N = 0.0;
                for (int i = 0; i < 2000; ++i)
                {
                    motion.Position_m = new Vector(high.X, high.Y, high.Z + 2e-3 - 2e-6 * i);
                    tip.Step(ref motion, ref touch);
                    most_N = Math.Max(most_N, touch.Force_N.Length);
                }
                Expect(most_N > 0.1 && most_N < 20.0, "the highest point is felt: " + most_N + " N");
            }
        }
    }

    private static void TracksAreContinuousAndGoStale()
    {
        TargetTrack track = new TargetTrack();
        Vector p, v;
        Expect(!track.At(0.0, out p, out v), "no position, no motion");
        for (int frame = 0; frame < 10; ++frame) track.Push(frame / 90.0, new Vector(0.001 * frame, 0, 0));
        Expect(track.At(9.5 / 90.0, out p, out v), "a motion");
        Near(p.X, 0.0085, 1e-12, "half a frame after the last, one frame late");
        Near(v.X, 0.09, 1e-9, "velocity of 1 mm a frame");
        Expect(track.At(9.0 / 90.0 + 0.09, out p, out v) && v.X == 0.0, "a late frame: it rests");
        Near(p.X, 0.009, 1e-12, "at the last position");
        Expect(!track.At(9.0 / 90.0 + 0.11, out p, out v), "stale after 0.1 s");
        Expect(!track.Push(10.0 / 90.0, new Vector(0.5, 0, 0)), "a jump of half a metre");
        Expect(!track.At(10.0 / 90.0, out p, out v), "after a jump there is no motion");
        Expect(!track.Push(11.0 / 90.0, new Vector(double.NaN, 0, 0)), "nan");
    }

    // The force of a loop whose application has stopped is zero within 0.15 s.
    private static void ALoopWithoutPositionsHasNoForce()
    {
        using (FeelScene plate = Plate())
        {
            plate.SetStiffness(500.0);
            using (HapticLoop loop = new HapticLoop(new FeelTip(plate, null), 1000.0))
            {
                loop.Start();
                double most_N = 0.0;
                for (int frame = 0; frame < 90; ++frame)
                {
                    loop.SetTarget(new Vector(0.01, 0.01, 1e-3 - Math.Min(2e-3, 4e-5 * frame)));
                    Thread.Sleep(11);
                    most_N = Math.Max(most_N, loop.Last.Force_N.Z);
                }
                Near(most_N, 0.5, 0.01, "force 1 mm deep");
                // The hand has pressed and rests: the motor is still, though the force is 0.5 N.
                Expect(loop.Last.Vibration_N > 0.4, "the number itself has the static force: " + loop.Last.Vibration_N);
                Near(loop.Rumble(0.5), 0.0, 0.01, "rumble of a hand that rests");
                Thread.Sleep(150);
                Near(loop.Last.Force_N.Length, 0.0, 0.0, "force 150 ms after the last position");
                Expect(!loop.Last.IsTouching, "it touches nothing");
                Expect(loop.Fault == null, "no fault: " + loop.Fault);
                Expect(loop.Steps > 90, "at least a step a frame, however busy the machine: " + loop.Steps);
            }
        }
    }

    // The end is asked for on the loop's own thread, which cannot wait for itself.
    private static void ALoopCanEndInItsOwnStep()
    {
        using (FeelScene plate = Plate())
        {
            HapticLoop loop = new HapticLoop(new FeelTip(plate, null), 1000.0);
            int steps = 0;
            using (ManualResetEvent disposed = new ManualResetEvent(false))
            {
                loop.OnStep = touch =>
                {
                    if (++steps < 20) return;
                    loop.Dispose();
                    disposed.Set();
                };
                loop.Start();
                Expect(disposed.WaitOne(5000), "Dispose returns in OnStep");
            }
            long last = 0;
            for (int i = 0; i < 50 && (last = loop.Steps) == 0; ++i) Thread.Sleep(10);
            Thread.Sleep(50);
            Expect(steps == 20 && loop.Steps == 20, "no step follows: " + steps + ", " + loop.Steps);
            Near(loop.Last.Force_N.Length, 0.0, 0.0, "force after the end");
            Expect(loop.Fault == null, "no fault: " + loop.Fault);
            loop.Dispose();  // again, from outside
            Expect(loop.Fault == null && last <= 20, "twice is allowed");
        }
    }

    private static void SoundHasTheForcesFrequency()
    {
        VibrationStream stream = new VibrationStream(1000.0, 512);
        float[] block = new float[2 * 480], sound = new float[48000];
        int at = 0, forces = 0;
        for (int b = 0; b < 100; ++b)
        {
            for (int i = 0; i < 10; ++i, ++forces) stream.Push(0.25 * Math.Sin(2.0 * Math.PI * 150.0 * forces / 1000.0));
            stream.Fill(block, 2, 48000.0, 1.0, 0.5);
            for (int i = 0; i < 480; ++i) sound[at++] = block[2 * i];
            Expect(block[0] == block[1], "both channels");
        }
        int rises = 0;
        double square = 0.0;
        for (int i = 24000; i < 48000; ++i)
        {
            if (sound[i - 1] < 0 && sound[i] >= 0) ++rises;
            square += sound[i] * sound[i] / 24000.0;
        }
        Near(rises, 75, 1, "75 periods in half a second");
        // Straight lines between 1,000 forces a second leave sinc² of a wave of 150 Hz, 0.928; the high-pass 0.999.
        Near(Math.Sqrt(2.0 * square), 0.5 * 0.928 * 0.999, 0.01, "amplitude");
        // The loop stops: silence after some 50 ms.
        for (int b = 0; b < 60; ++b) stream.Fill(block, 2, 48000.0, 1.0, 0.5);
        double loudest = 0.0;
        foreach (float s in block) loudest = Math.Max(loudest, Math.Abs(s));
        Expect(loudest < 1e-3, "silence: " + loudest);
    }

    // What a hand does slowly is neither sound nor rumble; what vibrates on it passes (closed form of the filter).
    private static void AForceThatRestsIsNoVibration()
    {
        HighPass filter = new HighPass(30.0, 1000.0);
        double square = 0.0, highest = 0.0;
        for (int i = 0; i < 4000; ++i)
        {
            double out_N = filter.Push(2.0 + 0.2 * Math.Sin(2.0 * Math.PI * 100.0 * i / 1000.0));
            if (i >= 2000) square += out_N * out_N / 2000.0;
        }
        double ratio = Math.Tan(Math.PI * 0.03) / Math.Tan(Math.PI * 0.1);
        Near(Math.Sqrt(2.0 * square), 0.2 / Math.Sqrt(1.0 + Math.Pow(ratio, 4.0)), 1e-6, "a sine of 100 Hz on 2 N");
        filter.StartAt(3.0);
        for (int i = 0; i < 100; ++i) highest = Math.Max(highest, Math.Abs(filter.Push(3.0)));
        Near(highest, 0.0, 1e-12, "a force that was always there");

        VibrationStream stream = new VibrationStream(1000.0, 512);
        float[] block = new float[480];
        double loudest = 0.0;
        for (int b = 0; b < 100; ++b)
        {
            for (int i = 0; i < 10; ++i) stream.Push(0.5);
            stream.Fill(block, 1, 48000.0, 1.0, 0.5);
            if (b >= 50) foreach (float s in block) loudest = Math.Max(loudest, Math.Abs(s));
        }
        Near(loudest, 0.0, 1e-4, "sound of a hand that rests");
    }

    private static void FramesAreReflections()
    {
        foreach (UpAxis up in new[] { UpAxis.Z, UpAxis.Y })
        {
            Vector v = new Vector(1, 2, 3), back = Frames.Map(Frames.Map(v, up), up);
            Near((back - v).Length, 0.0, 0.0, "there and back");
            // A turn of 90° about z takes x to y: in Unity's frame the mapped rotation takes the mapped x to the mapped y.
            double h = Math.Sqrt(0.5);
            double[] q = Frames.MapRotation(new[] { h, 0, 0, h }, up);
            Vector x = Frames.Map(new Vector(1, 0, 0), up), y = Frames.Map(new Vector(0, 1, 0), up);
            Near((Rotate(q, x) - y).Length, 0.0, 1e-12, "rotations are mapped with the vectors, " + up);
        }
        Near(Frames.Map(new Vector(0, 0, 1), UpAxis.Z).Y, 1.0, 0.0, "up is up");
        Near(Frames.Map(new Vector(0, 1, 0), UpAxis.Y).Y, 1.0, 0.0, "up is up");
    }

    private static Vector Rotate(double[] q, Vector v)
    {
        Vector u = new Vector(q[1], q[2], q[3]);
        double dot = u.X * v.X + u.Y * v.Y + u.Z * v.Z, square = u.X * u.X + u.Y * u.Y + u.Z * u.Z;
        Vector cross = new Vector(u.Y * v.Z - u.Z * v.Y, u.Z * v.X - u.X * v.Z, u.X * v.Y - u.Y * v.X);
        return 2.0 * dot * u + (q[0] * q[0] - square) * v + 2.0 * q[0] * cross;
    }

    private static void Write(string folder, string name, string text)
    {
        string file = Path.Combine(folder, name);
        Directory.CreateDirectory(Path.GetDirectoryName(file));
        File.WriteAllText(file, text);
    }

    // What a scene consists of, and nothing else that is beside it.
    private static void ScenesNameTheirFiles(string folder)
    {
        Write(folder, "a.scene.json", "{\"mesh\": \"cup.obj\", \"covered\": \"covered.json\", \"textures\": [{\"index\": 1, \"file\": \"t/wood.texture.json\"}], " +
            "\"extra\": {\"mesh\": \"private.txt\", \"n\": [1, -2.5e-3, true, null, \"\\u00e4\\n\"]}, " +
            "\"objects\": [{\"mesh\": \"lid.gltf\", \"material\": \"map.json\", \"textures\": []}]}");
        Write(folder, "cup.obj", "mtllib cup colours.mtl\nmtllib gone.mtl\nv 0 0 0\n");
        Write(folder, "lid.gltf", "{\"buffers\": [{\"uri\": \"lid%20data.bin\"}, {\"uri\": \"data:;base64,AA==\"}], \"images\": [{\"uri\": \"gone.png\"}, {\"uri\": \"../private.png\"}, {\"uri\": \"there.png\"}]}");
        Write(folder, "t/wood.texture.json", "{\"model\": \"heightmap\", \"heightmap\": {\"file\": \"wood.heights.png\"}}");
        foreach (string name in new[] { "cup colours.mtl", "lid data.bin", "covered.json", "map.json", "t/wood.heights.png", "there.png", "private.txt", "t/other.png" })
            Write(folder, name, "{}");
        string found = string.Join("|", Asperity.Feel.Editor.SceneFiles.Of(Path.Combine(folder, "a.scene.json")));
        Expect(found == "a.scene.json|covered.json|cup colours.mtl|cup.obj|lid data.bin|lid.gltf|map.json|t/wood.heights.png|t/wood.texture.json|there.png", found);
        Write(folder, "mesh.scene.json", "{\"mesh\": \"cup.obj\"}");
        foreach (string bad in new[] { "../private.txt", "t/../../private.txt", "/etc/hostname", "C:\\\\a.obj", "./cup.obj", "" })
        {
            Write(folder, "bad.scene.json", "{\"mesh\": \"" + bad + "\"}");
            Throws<IOException>(() => Asperity.Feel.Editor.SceneFiles.Of(Path.Combine(folder, "bad.scene.json")), "not in the scene's folder");
            Write(folder, "bad.texture.json", "{\"model\": \"areal\", \"areal\": {\"file\": \"../" + bad + "\"}}");
            Write(folder, "worse.scene.json", "{\"mesh\": \"cup.obj\", \"textures\": [{\"file\": \"bad.texture.json\"}]}");
            Throws<IOException>(() => Asperity.Feel.Editor.SceneFiles.Of(Path.Combine(folder, "worse.scene.json")), "not in the scene's folder");
        }
        LinksAreRefused(folder);
        foreach (string bad in new[] { "", "{", "[]", "{\"mesh\" \"a\"}", "{\"mesh\": \"\\q\"}", "{} x", new string('[', 100000), "{\"mesh\": \"a", "nope" })
        {
            Write(folder, "bad.scene.json", bad);
            Throws<IOException>(() => Asperity.Feel.Editor.SceneFiles.Of(Path.Combine(folder, "bad.scene.json")), "bad.scene.json");
        }
    }

    // A link leads to a file that may not be the scene's; a folder behind one likewise.
    private static void LinksAreRefused(string folder)
    {
        if (Path.DirectorySeparatorChar != '/') return;
        foreach (string link in new[] { "link.obj", "linked" })
        {
            using (System.Diagnostics.Process made = System.Diagnostics.Process.Start("ln", "-s \"" + Path.Combine(folder, link == "linked" ? "t" : "cup.obj") + "\" \"" + Path.Combine(folder, link) + "\""))
                made.WaitForExit();
            Write(folder, "link.scene.json", "{\"mesh\": \"cup.obj\", \"covered\": \"" + (link == "linked" ? "linked/wood.heights.png" : link) + "\"}");
            Throws<IOException>(() => Asperity.Feel.Editor.SceneFiles.Of(Path.Combine(folder, "link.scene.json")), "which is a link or behind one");
        }
    }

    private static void ScenesAreCopied(string file, string folder)
    {
        string beside = Path.Combine(Path.GetDirectoryName(file), "private.txt");
        File.WriteAllText(beside, "not the scene's");
        string first = Asperity.Feel.Editor.SceneImporter.CopyScene(file, folder);
        string second = Asperity.Feel.Editor.SceneImporter.CopyScene(file, folder);
        File.Delete(beside);
        Expect(first != second, "what is there is kept: " + first + ", " + second);
        using (FeelScene copy = FeelScene.Read(Path.Combine(folder, second))) Expect(copy.ObjectCount >= 1, "the copy is whole");
        Expect(!File.Exists(Path.Combine(folder, Path.GetDirectoryName(second), "private.txt")), "what the scene does not name is not copied");
    }

    private static int Main(string[] arguments)
    {
        LayoutIsThatOfTheHeader();
        APlateIsFelt();
        ErrorsAreExceptions();
        TracksAreContinuousAndGoStale();
        ALoopWithoutPositionsHasNoForce();
        ALoopCanEndInItsOwnStep();
        SoundHasTheForcesFrequency();
        AForceThatRestsIsNoVibration();
        FramesAreReflections();
        ASceneIsReadShownAndFelt(arguments[0]);
        ScenesNameTheirFiles(Path.Combine(arguments[1], "named"));
        ScenesAreCopied(arguments[0], arguments[1]);
        Console.WriteLine((checks - failed) + " of " + checks + " checks hold");
        return failed == 0 ? 0 : 1;
    }
}
