using System.Text;
using System.Text.Json;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Exports;
using FractalEngine.Parsing.Exports.Gltf;
using FractalEngine.Parsing.Exports.Ply;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Exports;

/// <summary>Scenes as glTF, read back by the reader of files of others, and as plain JSON.</summary>
public sealed class GltfExportTests : IDisposable
{
    // Floats of coordinates up to about 10.
    private const double Tolerance = 3e-6;

    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    private ExportSummary Export(LoadedScene scene, ExportSettings? settings = null)
    {
        using var stream = File.Create(_folder["a.glb"]);
        return new GltfExport().Write(scene, settings ?? new(), stream);
    }

    private JsonElement Json()
    {
        var bytes = File.ReadAllBytes(_folder["a.glb"]);
        Assert.Equal("glTF", Encoding.ASCII.GetString(bytes, 0, 4));
        Assert.Equal((uint)bytes.Length, BitConverter.ToUInt32(bytes, 8));
        return JsonDocument.Parse(bytes.AsMemory(20, (int)BitConverter.ToUInt32(bytes, 12))).RootElement;
    }

    /// <summary>A left-handed scene is mirrored, a right-handed one stays, and all faces keep their sides.</summary>
    [Theory]
    [InlineData("assets/fractals/menger-3.fdo", false)]
    [InlineData("assets/fractals/tree.fdo", false)]
    [InlineData("assets/fractals/fern.fdo", true)]
    [InlineData("assets/fractals/shell.fdo", false)]
    [InlineData("assets/fractals/snowflake.fdo", false)]
    [InlineData("assets/examples/rowan.fdo", false)]
    [InlineData("assets/models/crate.obj", false)]
    public void Fractal_ReadBack_HasTheFacesOfItsExpansion(string file, bool isSkewed)
    {
        var loaded = AssetLoader.Load(Repository.Full(file), new() { Depth = file.Contains("fdo", StringComparison.Ordinal) ? 2 : null });
        var summary = Export(loaded.Scene);
        var expected = loaded.Scene.Objects.Flatten(10_000_000);
        var actual = MeshFile.Read(_folder["a.glb"]);
        Assert.Equal(expected.FaceCount, actual.FaceCount);
        Assert.Equal(isSkewed, summary.Losses.Any(static loss => loss.Contains("skewed", StringComparison.Ordinal)));
        var mirror = loaded.Scene.Scene.Handedness == Core.Scenes.Cameras.Handedness.Left ? -1 : 1;
        Assert.Equal(Centres(expected, mirror), Centres(actual, 1), (a, b) => Near.Difference(a, b) < Tolerance);
        Near.Equal(expected.SurfaceArea(), actual.SurfaceArea(), 1e-5 * expected.SurfaceArea());
        // The sides of a closed mesh decide about the sign of its volume. The fern is a sheet, which has none.
        Near.Equal(Volume(expected), Volume(actual), isSkewed ? 1e-3 : 1e-5 * Math.Max(1, Math.Abs(Volume(expected))));
    }

    private static List<Vector> Centres(Mesh mesh, int mirror) =>
    [
        .. Enumerable.Range(0, mesh.FaceCount).Select(face =>
        {
            var (a, b, c) = mesh.Face(face);
            var (x, y, z) = (a + b + c) / 3;
            return new Vector(x, y, mirror * z);
        }).OrderBy(static v => Math.Round(v.X, 4)).ThenBy(static v => Math.Round(v.Y, 4)).ThenBy(static v => Math.Round(v.Z, 4)),
    ];

    private static double Volume(Mesh mesh) => Enumerable.Range(0, mesh.FaceCount).Sum(face =>
    {
        var (a, b, c) = mesh.Face(face);
        return Vector.Dot(a, Vector.Cross(b, c)) / 6;
    });

    [Fact]
    public void Instances_OfAMillionFaces_AreAFewNumbersEach()
    {
        var scene = AssetLoader.Load(Repository.Full("assets/fractals/menger-4.fdo")).Scene;
        Export(scene);
        // 160,000 cubes: a translation, a rotation and a scale each, of 40 bytes.
        Assert.InRange(new FileInfo(_folder["a.glb"]).Length, 160_000 * 40, (160_000 * 40) + 4000);
        var json = Json();
        Assert.Equal("EXT_mesh_gpu_instancing", Assert.Single(json.GetProperty("extensionsRequired").EnumerateArray()).GetString());
        Assert.Equal(1, json.GetProperty("meshes").GetArrayLength());
    }

    [Fact]
    public void WhatTheFormatLacks_IsTold()
    {
        File.Copy(Repository.Full("assets/models/crate.png"), _folder["crate.png"]);
        File.WriteAllText(_folder["m.mtl"], "newmtl Leaf\nmap_d crate.png\n");
        File.WriteAllText(_folder["leaf.fdo"], "<$>. box material \"m.mtl\"\n");
        File.WriteAllText(_folder["row.fdo"], "<$>. [((1, 0, 0), #, #)^0..3] box\n");
        File.WriteAllText(_folder["s.sdo"], """
            c (0, 0, -5) # 60
            projection orthographic 4
            light directional (0, -1, 0) (1, 1, 1) 1
            o "leaf.fdo" #
            o "row.fdo" # gradient height "ember" glow 0 1
            """);
        Assert.Equal(
            [
                "images of opacity or heights are left out, in materials: 1",
                "roughness, metal and glow of gradients are not written",
                "the camera is not written, since it is orthographic",
            ],
            Export(AssetLoader.Load(_folder["s.sdo"]).Scene).Losses.ToArray());
    }

    [Fact]
    public void Scene_WithMaterialsCameraAndLights_KeepsThem()
    {
        File.Copy(Repository.Full("assets/models/crate.png"), _folder["crate.png"]);
        File.WriteAllText(_folder["m.mtl"], "newmtl Tiles\nmap_Kd crate.png\nKe 3 0 0\nd 0.5\nPr 0.25\nPm 1\n");
        File.WriteAllText(_folder["box.fdo"], "<$>. box material \"m.mtl\"\n");
        File.WriteAllText(_folder["s.sdo"], """
            c (0, 0, -5) # 60
            light directional (0, -1, 0) (1, 0.5, 0.5) 2
            light point (1, 2, 3) (1, 1, 1) 1 10
            light spot (1, 2, 3) (0, -1, 0) 60 (1, 1, 1) 1 10
            light ambient (1, 1, 1) 0.5
            o "box.fdo" ((0, 0, 1), #, #) colour (0.5, 1, 1)
            """);
        Assert.Equal(["light from all around is not written"], Export(AssetLoader.Load(_folder["s.sdo"]).Scene).Losses.ToArray());
        var json = Json();
        var material = json.GetProperty("materials")[0];
        var surface = material.GetProperty("pbrMetallicRoughness");
        Assert.Equal(("BLEND", 0.25, 1), (
            material.GetProperty("alphaMode").GetString(), surface.GetProperty("roughnessFactor").GetDouble(),
            surface.GetProperty("metallicFactor").GetDouble()));
        Near.Equal(0.2140411, surface.GetProperty("baseColorFactor")[0].GetDouble(), 1e-6); // 0.5 of sRGB in linear light
        Assert.Equal([1.0, 0, 0], material.GetProperty("emissiveFactor").EnumerateArray().Select(static one => one.GetDouble()));
        Assert.Equal(3, material.GetProperty("extensions").GetProperty("KHR_materials_emissive_strength").GetProperty("emissiveStrength")
            .GetDouble());
        var model = AssetLoader.Load(_folder["a.glb"]).Scene.Objects[0].Model;
        Assert.Equal(File.ReadAllBytes(_folder["crate.png"]), model.Materials["Tiles"].Texture!.Contents);
        // A mesh at one place needs no extension.
        Assert.False(json.TryGetProperty("extensionsRequired", out _));
        var nodes = json.GetProperty("nodes").EnumerateArray().Where(static node => !node.TryGetProperty("mesh", out _)).Select(
            static node => node.GetProperty("matrix").EnumerateArray().Select(static one => one.GetDouble()).ToArray()).ToList();
        // The camera before the mirror at z = −5, and behind it at 5; it looks along its own −z. So does the light that falls.
        Assert.Equal([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1], nodes[0]);
        Assert.Equal([0.0, 1, 0], nodes[1][8..11]);
        Assert.Equal([1.0, 2, -3], nodes[2][12..15]);
        var lights = json.GetProperty("extensions").GetProperty("KHR_lights_punctual").GetProperty("lights");
        Near.Equal(2 * Math.PI, lights[0].GetProperty("intensity").GetDouble(), 1e-12);
        Near.Equal(Math.PI / 6, lights[2].GetProperty("spot").GetProperty("outerConeAngle").GetDouble(), 1e-12);
        Near.Equal(
            Math.PI / 3, json.GetProperty("cameras")[0].GetProperty("perspective").GetProperty("yfov").GetDouble(), 1e-12);
        // A tenth of the range of 10 is 1, where the light brings π.
        Near.Equal(Math.PI, lights[1].GetProperty("intensity").GetDouble(), 1e-12);
    }

    /// <summary>Maps mix colours into those of each material; what is skewed has them at its vertices, and so has all where flat.</summary>
    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void ColoursOfMaps_MixWithEachMaterial(bool isFlat)
    {
        File.WriteAllText(_folder["m.mtl"], "newmtl A\nKd 1 0 0\nnewmtl B\nKd 0 1 0\n");
        File.WriteAllText(_folder["m.obj"], """
            mtllib m.mtl
            v 0 0 0
            v 1 0 0
            v 0 1 0
            v 0 0 1
            usemtl A
            f 1 2 3
            usemtl B
            f 1 3 4

            """);
        File.WriteAllText(_folder["a.fdo"], """
            x. "m.obj"
            skew.matrix (1, 0, 0) (0.5, 1, 0) (0, 0, 1) (6, 0, 0)
            <$>. [#, ((3, 0, 0), #, #) colour (0, 0, 1) 1, (#, #, #) colour (0, 0, 1) 0.25 * skew.] x

            """);
        var summary = Export(AssetLoader.Load(_folder["a.fdo"]).Scene, new() { IsFlat = isFlat });
        Assert.Equal(isFlat ? 0 : 1, summary.Losses.Length);
        var json = Json();
        Assert.Equal(isFlat, !json.TryGetProperty("extensionsRequired", out _));
        // By the materials of the primitives: colours of instances, and those of vertices, each once.
        var found = new List<(string Material, Vector Colour)>();
        foreach (var node in json.GetProperty("nodes").EnumerateArray())
        {
            foreach (var primitive in json.GetProperty("meshes")[node.GetProperty("mesh").GetInt32()].GetProperty("primitives")
                .EnumerateArray())
            {
                var material = json.GetProperty("materials")[primitive.GetProperty("material").GetInt32()].GetProperty("name").GetString()!;
                var accessor = node.TryGetProperty("extensions", out var extensions)
                    ? extensions.GetProperty("EXT_mesh_gpu_instancing").GetProperty("attributes").GetProperty("_COLOR_0")
                    : primitive.GetProperty("attributes").GetProperty("COLOR_0");
                found.AddRange(VectorsOf(json, accessor.GetInt32()).Distinct().Select(colour => (material, colour)));
            }
        }

        Assert.Equal(
            [("A", new(0, 0, 1)), ("A", new(0.75, 0, 0.25)), ("A", new(1, 0, 0)),
             ("B", new(0, 0, 1)), ("B", new(0, 0.75, 0.25)), ("B", new(0, 1, 0))],
            found.Distinct().OrderBy(static one => one.Material).ThenBy(static one => one.Colour.X + one.Colour.Y),
            static ((string Material, Vector Colour) a, (string Material, Vector Colour) b) =>
                a.Material == b.Material && Near.Difference(a.Colour, b.Colour) < Tolerance);
    }

    /// <summary>Corners have the same texture coordinates after a way through a format whose v points down.</summary>
    [Fact]
    public void TextureCoordinates_ReadBack_AreTheSame()
    {
        var model = (MeshModel)AssetLoader.Load(Repository.Full("assets/models/crate.obj")).Scene.Objects[0].Model;
        Export(AssetLoader.Load(Repository.Full("assets/models/crate.obj")).Scene);
        var read = MeshFile.Read(_folder["a.glb"]);
        Assert.Equal(CornersOf(model.Mesh).Order(), CornersOf(read).Order());

        static IEnumerable<(string Position, string Coordinate)> CornersOf(Mesh mesh) => mesh.VertexIndices.Zip(mesh.TextureIndices).Select(
            corner => (mesh.Vertex(corner.First).ToString(), string.Create(
                System.Globalization.CultureInfo.InvariantCulture,
                $"{mesh.TextureCoordinates[2 * corner.Second]:F5} {mesh.TextureCoordinates[(2 * corner.Second) + 1]:F5}")));
    }

    /// <summary>Two materials have one image, of an odd number of bytes: one repeats it elsewhere, and the other ends it.</summary>
    [Fact]
    public void Textures_ReadBack_AreWhereTheyWere()
    {
        var bytes = File.ReadAllBytes(Repository.Full("assets/models/crate.png"));
        // What stands behind the image belongs to no reader of it.
        bytes = [.. bytes, .. new byte[1 - (bytes.Length % 2)]];
        File.WriteAllBytes(_folder["tiles.png"], bytes);
        File.WriteAllText(
            _folder["m.mtl"], "newmtl Moved\nmap_Kd -s 2 3 -o 0.25 0.5 tiles.png\nnewmtl Ended\nmap_Kd -clamp on tiles.png\n");
        File.WriteAllText(
            _folder["a.obj"], "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
            + "usemtl Moved\nf 1/1 2/2 3/3\nusemtl Ended\nf 1/1 3/3 4/4\n");
        Export(AssetLoader.Load(_folder["a.obj"]).Scene);
        var model = AssetLoader.Load(_folder["a.glb"]).Scene.Objects[0].Model;
        Assert.Equal(new(Vector.Zero, new(1, 1, 0)), model.Mesh.UsedBounds);
        Assert.All(model.Materials.Values, material => Assert.Equal(bytes, material.Texture!.Contents));
        Assert.Equal((false, true), (model.Materials["Moved"].Texture!.IsClamped, model.Materials["Ended"].Texture!.IsClamped));
        Assert.Equal([0.25, 0.5, 2.25, 0.5, 2.25, 3.5], CoordinatesOf("Moved"));
        Assert.Equal([0, 0, 1, 1, 0, 1], CoordinatesOf("Ended"));

        double[] CoordinatesOf(string material)
        {
            var face = model.Mesh.Groups.Single(group => group.Material == material).FirstFace;
            return [.. model.Mesh.TextureIndices.Skip(3 * face).Take(3).SelectMany(i => model.Mesh.TextureCoordinates.Skip(2 * i).Take(2))];
        }
    }

    /// <summary>Normals of instances with faces of their own stay on the side that the corners turn around, mirrored or not.</summary>
    [Fact]
    public void Normals_OfSkewedMirrors_PointOutward()
    {
        File.WriteAllText(_folder["a.fdo"], """
            skew.matrix (1, 0, 0) (0.5, 1, 0) (0, 0, 1) (6, 0, 0)
            twin.matrix (-1, 0, 0) (0.5, 1, 0) (0, 0, 1) (9, 0, 0)
            <$>. [skew., twin.] box

            """);
        Export(AssetLoader.Load(_folder["a.fdo"]).Scene);
        var mesh = MeshFile.Read(_folder["a.glb"]);
        Assert.Equal(24, mesh.FaceCount);
        for (var corner = 0; corner < mesh.VertexIndices.Length; corner++)
        {
            var (a, b, c) = mesh.Face(corner / 3);
            var normal = mesh.Normals.AsSpan(3 * mesh.NormalIndices[corner], 3);
            Assert.True(Vector.Dot(new(normal[0], normal[1], normal[2]), Vector.Cross(b - a, c - a)) > 0);
        }
    }

    private List<Vector> VectorsOf(JsonElement json, int accessor)
    {
        var bytes = File.ReadAllBytes(_folder["a.glb"]);
        var one = json.GetProperty("accessors")[accessor];
        var start = 28 + (int)BitConverter.ToUInt32(bytes, 12)
            + json.GetProperty("bufferViews")[one.GetProperty("bufferView").GetInt32()].GetProperty("byteOffset").GetInt32();
        return [.. Enumerable.Range(0, one.GetProperty("count").GetInt32()).Select(i => new Vector(
            BitConverter.ToSingle(bytes, start + (12 * i)), BitConverter.ToSingle(bytes, start + (12 * i) + 4),
            BitConverter.ToSingle(bytes, start + (12 * i) + 8)))];
    }

    /// <summary>Positions of vertices, of instances and of the camera: none is written that a float can't tell.</summary>
    [Theory]
    [InlineData("v 1e300 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n", "o \"m.obj\" #")]
    [InlineData("v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n", "o \"m.obj\" ((1e39, 0, 0), #, #)")]
    [InlineData("v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n", "c (0, 0, 1e300) # 60\no \"m.obj\" #")]
    [InlineData("v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n", "o \"m.obj\" (#, #, (1e30, 1e30, 1e30))")]
    public void Coordinates_BeyondFloats_AreRefused(string mesh, string scene)
    {
        File.WriteAllText(_folder["m.obj"], mesh);
        File.WriteAllText(_folder["s.sdo"], scene + "\n");
        Assert.StartsWith("a coordinate is beyond the range of a float: ", Assert.Throws<Core.FractalEngineException>(
            () => Export(AssetLoader.Load(_folder["s.sdo"]).Scene, new() { UnitLength = 1e10 })).Message, StringComparison.Ordinal);
    }

    [Fact]
    public void Gradients_InFilesWithColours_AreThoseOfEachInstance()
    {
        File.WriteAllText(_folder["f.fdo"], "up.p. (p, #, #)\nx. [#, up.(0, 3, 0)] box\n<$>. x\n");
        File.WriteAllText(_folder["s.sdo"], "o \"f.fdo\" # colour (1, 1, 1) gradient height (1, 0, 0)");
        var scene = AssetLoader.Load(_folder["s.sdo"]).Scene;
        Assert.Empty(Export(scene).Losses);
        var fractal = ((FractalModel)AssetLoader.Load(_folder["a.glb"]).Scene.Objects[0].Model).Fractal;
        var set = (Core.Fractals.Descriptions.TransformationSet)fractal.Description.Steps[0];
        // Centres of boxes of height 1 are at an eighth of a height of 4, and at seven eighths: so much red is in white, of linear light.
        foreach (var (map, colour) in set.Maps.Zip(set.Colours))
        {
            var (red, green, blue) = colour.Colour.ToLinear();
            var part = (map.Translation.Y + 0.5) / 4;
            Near.Equal(new Vector(1, 1 - part, 1 - part), new(red, green, blue), 1e-6);
        }

        using var stream = new MemoryStream();
        Assert.Empty(new PlyExport().Write(scene, new(), stream).Losses);
        var bytes = stream.ToArray();
        var start = Encoding.ASCII.GetString(bytes).IndexOf("end_header\n", StringComparison.Ordinal) + 11;
        // Vertices of 27 bytes, eight of each box. The sRGB of 7/8 and of 1/8 is 0.943 and 0.389.
        foreach (var vertex in Enumerable.Range(0, 16).Select(vertex => start + (27 * vertex)))
        {
            var other = BitConverter.ToDouble(bytes, vertex + 8) > 1 ? 99 : 240;
            Assert.Equal((255, other, other), (bytes[vertex + 24], bytes[vertex + 25], bytes[vertex + 26]));
        }
    }

    [Theory]
    [InlineData("left", 1)]
    [InlineData("right", 1)]
    [InlineData("right", 8)]
    public void CameraAndLights_ReadBack_AreWhatWasOnTheScreen(string handed, double unit)
    {
        File.Copy(Repository.Full("assets/models/crate.obj"), _folder["crate.obj"]);
        File.WriteAllText(_folder["s.sdo"], $"""
            handed {handed}
            c (3, 1, -5) (0.1, -0.4, 0.2) 47
            light directional (1, -1, 2) (1, 0.5, 0.25) 2
            light point (1, 2, 3) (0.3, 1, 1) 1.5 10
            light spot (4, 5, 6) (0, -1, 0.5) 40 (1, 1, 0.2) 3 25
            o "crate.obj" #
            """);
        var written = AssetLoader.Load(_folder["s.sdo"]).Scene.Scene;
        Export(LoadedScene.Of(written), new() { UnitLength = unit });
        var read = AssetLoader.Load(_folder["a.glb"], new() { IsStaged = true }).Scene.Scene;
        var mirror = Matrix.Diagonal(new(1, 1, handed == "left" ? -1 : 1));
        // Numbers of at most 25, in floats.
        Near.Equal(unit * (mirror * written.Camera!.Position), read.Camera!.Position, unit * 1e-6);
        Near.Equal(mirror * written.Camera.LocalAxes, read.Camera.LocalAxes, 1e-6);
        Near.Equal(1, read.Camera.FieldOfView / written.Camera.FieldOfView, 1e-6);
        Assert.Equal(written.Lights.Select(static light => light.Kind), read.Lights.Select(static light => light.Kind));
        foreach (var (expected, actual) in written.Lights.Zip(read.Lights, static (a, b) => (a.ToEmitter()!, b.ToEmitter()!)))
        {
            Near.Equal(unit * (mirror * (expected.Position ?? Vector.Zero)), actual.Position ?? Vector.Zero, unit * 1e-6);
            Near.Equal(mirror * expected.Axis, actual.Axis, 1e-6);
            Near.Equal(expected.Radiance, actual.Radiance, 1e-6);
            Near.Equal(0, double.IsInfinity(expected.Range) ? 0 : (unit * expected.Range) - actual.Range, unit * 1e-6);
            Near.Equal(1, actual.ConeAngle / expected.ConeAngle, 1e-6);
        }

        Assert.Null(read.Sky);
        Assert.False(read.HasAutoExposure);
    }

    [Fact]
    public void SameScene_WrittenTwice_HasTheSameBytes()
    {
        var scene = AssetLoader.Load(Repository.Full("assets/fractals/fern.fdo"), new() { Depth = 1 }).Scene;
        Export(scene);
        var first = File.ReadAllBytes(_folder["a.glb"]);
        Export(scene);
        Assert.Equal(first, File.ReadAllBytes(_folder["a.glb"]));
    }

    [Fact]
    public void Fractal_OfMoreFacesThanTheLimit_WritesNothing()
    {
        var scene = AssetLoader.Load(Repository.Full("assets/fractals/menger.fdo")).Scene;
        Assert.ThrowsAny<Core.FractalEngineException>(() => Export(scene, new() { MaxFaces = 1000 }));
        Assert.Equal(0, new FileInfo(_folder["a.glb"]).Length);
    }
}
