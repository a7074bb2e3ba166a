using System.Globalization;
using System.Text;
using System.Text.Json.Nodes;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Images;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Mtl;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Gltf;

/// <summary>glTF files that are written here byte by byte, after the specification of glTF 2.0.</summary>
public sealed class GltfReaderTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    /// <summary>A file of one buffer, to which accessors are added one after the other.</summary>
    private sealed class Document
    {
        private readonly List<byte> _bytes = [];

        public JsonObject Root { get; } = JsonNode.Parse("""
            {"asset": {"version": "2.0"}, "buffers": [{}], "bufferViews": [], "accessors": [], "meshes": [], "nodes": [], "materials": []}
            """)!.AsObject();

        public JsonArray this[string name] => Root[name]!.AsArray();

        /// <summary>Adds an accessor of floats (5126), or of integers of another type.</summary>
        public int Add(string type, int componentType, int components, params double[] numbers)
        {
            Align();
            var start = _bytes.Count;
            foreach (var number in numbers)
            {
                _bytes.AddRange(componentType switch
                {
                    5121 => [(byte)number],
                    5123 => BitConverter.GetBytes((ushort)number),
                    5125 => BitConverter.GetBytes((uint)number),
                    _ => BitConverter.GetBytes((float)number),
                });
            }

            this["bufferViews"].Add(new JsonObject { ["buffer"] = 0, ["byteOffset"] = start, ["byteLength"] = _bytes.Count - start });
            var count = numbers.Length / components;
            var accessor = new JsonObject
            {
                ["bufferView"] = this["bufferViews"].Count - 1, ["componentType"] = componentType, ["count"] = count, ["type"] = type,
            };
            if (type == "VEC3" && componentType == 5126)
            {
                var columns = Enumerable.Range(0, 3).Select(i => numbers.Where((_, n) => n % 3 == i).ToArray()).ToArray();
                accessor["min"] = new JsonArray([.. columns.Select(static column => (JsonNode)column.Min())]);
                accessor["max"] = new JsonArray([.. columns.Select(static column => (JsonNode)column.Max())]);
            }

            this["accessors"].Add(accessor);
            return this["accessors"].Count - 1;
        }

        public int AddImage(byte[] contents)
        {
            var start = _bytes.Count;
            _bytes.AddRange(contents);
            this["bufferViews"].Add(new JsonObject { ["buffer"] = 0, ["byteOffset"] = start, ["byteLength"] = contents.Length });
            return this["bufferViews"].Count - 1;
        }

        public string Embedded()
        {
            Root["buffers"]![0]!["byteLength"] = _bytes.Count;
            Root["buffers"]![0]!["uri"] = "data:application/octet-stream;base64," + Convert.ToBase64String(_bytes.ToArray());
            return Trimmed().ToJsonString();
        }

        public (string Text, byte[] Buffer) Separate(string name)
        {
            Root["buffers"]![0]!["byteLength"] = _bytes.Count;
            Root["buffers"]![0]!["uri"] = name;
            return (Trimmed().ToJsonString(), _bytes.ToArray());
        }

        public byte[] Binary()
        {
            Align();
            Root["buffers"]![0]!["byteLength"] = _bytes.Count;
            Root["buffers"]![0]!.AsObject().Remove("uri");
            var json = Encoding.UTF8.GetBytes(Trimmed().ToJsonString());
            json = [.. json, .. Enumerable.Repeat((byte)' ', (4 - (json.Length % 4)) % 4)];
            var result = new MemoryStream();
            using var writer = new BinaryWriter(result);
            writer.Write("glTF"u8);
            writer.Write(2u);
            writer.Write((uint)(12 + 8 + json.Length + 8 + _bytes.Count));
            writer.Write((uint)json.Length);
            writer.Write("JSON"u8);
            writer.Write(json);
            writer.Write((uint)_bytes.Count);
            writer.Write("BIN\0"u8);
            writer.Write(_bytes.ToArray());
            writer.Flush();
            return result.ToArray();
        }

        private void Align() => _bytes.AddRange(new byte[(4 - (_bytes.Count % 4)) % 4]);

        // Empty arrays are not allowed.
        private JsonObject Trimmed()
        {
            foreach (var (name, value) in Root.ToList())
            {
                if (value is JsonArray { Count: 0 })
                {
                    Root.Remove(name);
                }
            }

            return Root;
        }
    }

    private static readonly double[] Quad = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0];

    private static Document QuadDocument(int mode = 4, double[]? indices = null, int indexType = 5123)
    {
        var document = new Document();
        var positions = document.Add("VEC3", 5126, 3, Quad);
        var primitive = new JsonObject { ["attributes"] = new JsonObject { ["POSITION"] = positions }, ["mode"] = mode };
        if (indices is not null)
        {
            primitive["indices"] = document.Add("SCALAR", indexType, 1, indices);
        }

        document["meshes"].Add(new JsonObject { ["name"] = "quad", ["primitives"] = new JsonArray(primitive) });
        document["nodes"].Add(new JsonObject { ["name"] = "here", ["mesh"] = 0 });
        return document;
    }

    private Mesh Read(string text) => MeshFile.Read(Write(text));

    private string Write(string text, string name = "a.gltf")
    {
        File.WriteAllText(_folder[name], text);
        return _folder[name];
    }

    [Theory]
    [InlineData(4, new double[] { 0, 1, 2, 0, 2, 3 }, 5121)]
    [InlineData(4, new double[] { 0, 1, 2, 0, 2, 3 }, 5123)]
    [InlineData(4, new double[] { 0, 1, 2, 0, 2, 3 }, 5125)]
    [InlineData(5, new double[] { 1, 2, 0, 3 }, 5121)]
    [InlineData(6, new double[] { 0, 1, 2, 3 }, 5123)]
    [InlineData(6, null, 5123)]
    public void Primitive_OfAnyModeAndIndices_HasItsTriangles(int mode, double[]? indices, int type)
    {
        var mesh = Read(QuadDocument(mode, indices, type).Embedded());
        Assert.Equal((4, 2), (mesh.VertexCount, mesh.FaceCount));
        Assert.Equal(Quad, mesh.Positions);
        // Both triangles face z, wherever they begin.
        Assert.All(Enumerable.Range(0, 2), face => Assert.Equal(1, Vector.Cross(Edge(face, 0), Edge(face, 1)).Z));
        Assert.Equal(1, mesh.SurfaceArea());

        Vector Edge(int face, int corner)
        {
            var (a, b, c) = mesh.Face(face);
            return corner == 0 ? b - a : c - b;
        }
    }

    [Fact]
    public void Binary_WithItsBuffer_IsTheMeshOfTheText()
    {
        var document = QuadDocument(4, [0, 1, 2, 0, 2, 3]);
        var expected = Read(document.Embedded());
        File.WriteAllBytes(_folder["a.glb"], document.Binary());
        Assert.Equal(expected.Positions.ToArray(), MeshFile.Read(_folder["a.glb"]).Positions);
        Assert.Equal(expected.VertexIndices.ToArray(), MeshFile.Read(_folder["a.glb"]).VertexIndices);
    }

    [Fact]
    public void Nodes_WithTransformsAndMirrors_PlaceTheirMeshes()
    {
        var document = QuadDocument(4, [0, 1, 2, 0, 2, 3]);
        document["nodes"].Clear();
        document["nodes"].Add(JsonNode.Parse("""{"children": [1, 2], "translation": [10, 0, 0], "scale": [2, 2, 2]}"""));
        document["nodes"].Add(JsonNode.Parse("""{"mesh": 0, "rotation": [0, 0, 0.70710678118, 0.70710678118]}"""));
        document["nodes"].Add(JsonNode.Parse("""{"mesh": 0, "matrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1]}"""));
        document.Root["scenes"] = JsonNode.Parse("""[{"nodes": [0]}]""");
        document.Root["scene"] = 0;
        var mesh = Read(document.Embedded());
        Assert.Equal((8, 4), (mesh.VertexCount, mesh.FaceCount));
        // A quarter turn about z takes x to y; then twice as large, and moved. The quaternion has twelve digits, in floats.
        Near.Equal(new Vector(10, 2, 0), mesh.Vertex(1), 1e-6);
        Near.Equal(new Vector(8, 10, 10) - new Vector(0, 10, 0), mesh.Vertex(5), 1e-6);
        // The mirrored one still shows its front to z.
        var (a, b, c) = mesh.Face(2);
        Assert.True(Vector.Cross(b - a, c - a).Z > 0);
    }

    private static void AddInstances(Document document, int node, int translations)
    {
        document.Root["extensionsUsed"] = JsonNode.Parse("""["EXT_mesh_gpu_instancing"]""");
        document["nodes"][node]!["extensions"] = JsonNode.Parse(string.Create(
            CultureInfo.InvariantCulture, $"{{\"EXT_mesh_gpu_instancing\": {{\"attributes\": {{\"TRANSLATION\": {translations}}}}}}}"));
    }

    [Fact]
    public void Instancing_PlacesAMeshOncePerInstance()
    {
        var document = QuadDocument(4, [0, 1, 2, 0, 2, 3]);
        var translations = document.Add("VEC3", 5126, 3, 1, 0, 0, 2, 0, 0, 3, 0, 0);
        AddInstances(document, 0, translations);
        var mesh = Read(document.Embedded());
        Assert.Equal((12, 6), (mesh.VertexCount, mesh.FaceCount));
        Assert.Equal([1.0, 2, 3], new[] { 0, 4, 8 }.Select(vertex => mesh.Vertex(vertex).X));
    }

    /// <summary>A tree of nodes, instances by an extension, a flattened node and a mesh that stands once.</summary>
    private string WriteInstances()
    {
        var document = QuadDocument(4, [0, 1, 2, 0, 2, 3]);
        var positions = document.Add("VEC3", 5126, 3, 0, 0, 0, 3, 0, 0, 0, 2, 1);
        document["materials"].Add(JsonNode.Parse("""{"name": "Red", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}"""));
        document["meshes"].Add(JsonNode.Parse("""{"name": "sail", "primitives": [{"attributes": {}, "material": 0}]}"""));
        document["meshes"][1]!["primitives"]![0]!["attributes"]!["POSITION"] = positions;
        var translations = document.Add("VEC3", 5126, 3, 1, 0, 0, 2, 5, 0, 3, 0, -7);
        document["nodes"].Clear();
        document["nodes"].Add(JsonNode.Parse("""{"children": [1, 2, 3], "translation": [10, 0, 0], "scale": [2, 3, 2]}"""));
        document["nodes"].Add(JsonNode.Parse("""{"mesh": 0, "rotation": [0.6, 0, 0, 0.8]}"""));
        document["nodes"].Add(JsonNode.Parse("""{"mesh": 0, "matrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1]}"""));
        document["nodes"].Add(JsonNode.Parse("""{"mesh": 0, "scale": [1, 0, 1]}"""));
        document["nodes"].Add(JsonNode.Parse("""{"mesh": 1}"""));
        document["nodes"].Add(JsonNode.Parse("""{"mesh": 0}"""));
        AddInstances(document, 5, translations);
        document.Root["scenes"] = JsonNode.Parse("""[{"nodes": [0, 4, 5]}]""");
        document.Root["scene"] = 0;
        return Write(document.Embedded());
    }

    [Fact]
    public void Instances_OpenedAlone_AreStoredOnceAndShowTheFacesOfTheMesh()
    {
        var baked = MeshFile.Read(WriteInstances());
        var file = AssetLoader.Load(_folder["a.gltf"], new() { IsStaged = true });
        var model = Assert.IsType<FractalModel>(file.Scene.Objects[0].Model);
        // The flattened place can't be a map, and is part of what stands once.
        Assert.Equal([3, 2], model.Fractal.BaseMeshes.Select(static mesh => mesh.FaceCount));
        Assert.Equal([1, 5], model.Parts.Select(static part => (int)part.InstanceCount!.Value));
        Assert.Equal(("a.gltf#others", "a.gltf#quad"), (model.MeshNameAt(0), model.MeshNameAt(1)));
        Assert.Equal("Red", Assert.Single(model.MaterialsAt(0)).Key);
        Assert.Null(file.Scene.Objects[0].Gradient);
        Assert.Equal((baked.FaceCount, baked.VertexCount), ((int)model.FaceCount!.Value, (int)model.VertexCount!.Value));
        // Sums in another order, of numbers up to 20.
        Near.Equal(baked.Bounds.Minimum, file.Scene.Bounds.Minimum, 1e-12);
        Near.Equal(baked.Bounds.Maximum, file.Scene.Bounds.Maximum, 1e-12);
        Near.Equal(baked.SurfaceArea(), SurfaceSummary.Of(file.Scene).Area!.Value, 1e-12);
        var point = new Vector(13, 1, -7);
        Near.Equal(
            Core.Colliders.Collider.For(baked).FindClosest(point).Distance,
            file.Scene.Objects[0].CreateCollider().FindClosest(point).Distance, 1e-12);
    }

    [Fact]
    public void Instances_AsTheBaseOfAFractal_AreOneMesh()
    {
        var baked = MeshFile.Read(WriteInstances());
        File.WriteAllText(_folder["a.fdo"], "x. \"a.gltf\"\nhanded right\n<$>. x\n");
        File.WriteAllText(_folder["a.sdo"], "o \"a.fdo\" #\no \"a.gltf\" #\n");
        var models = AssetLoader.Load(_folder["a.sdo"]).Scene.Models.ToArray();
        Assert.Equal(baked.Positions.ToArray(), Assert.Single(((FractalModel)models[0]).Fractal.BaseMeshes).Positions);
        Assert.Equal(2, ((FractalModel)models[1]).Fractal.BaseMeshes.Length);
        Assert.Equal(models[0].FaceCount, models[1].FaceCount);
    }

    [Fact]
    public void Instances_OfMoreThanAreDrawnByThemselves_AreOneMesh()
    {
        var document = QuadDocument(4, [0, 1, 2, 0, 2, 3]);
        var translations = document.Add("VEC3", 5126, 3, [.. Enumerable.Range(0, 360_000).Select(static i => (double)i)]);
        AddInstances(document, 0, translations);
        File.WriteAllBytes(_folder["a.glb"], document.Binary());
        Assert.Equal(240_000, Assert.IsType<MeshModel>(AssetLoader.Load(_folder["a.glb"]).Scene.Objects[0].Model).Mesh.FaceCount);
    }

    [Fact]
    public void CameraAndLights_OpenedAlone_AreThoseOfTheScene()
    {
        var document = QuadDocument(4, [0, 1, 2, 0, 2, 3]);
        document.Root["cameras"] = JsonNode.Parse("""
            [{"type": "orthographic", "orthographic": {"xmag": 3, "ymag": 2, "znear": 0.1, "zfar": 9}},
             {"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}]
            """);
        document.Root["extensionsUsed"] = JsonNode.Parse("""["KHR_lights_punctual"]""");
        document.Root["extensions"] = JsonNode.Parse("""
            {"KHR_lights_punctual": {"lights": [
              {"type": "directional", "color": [1, 0.25, 0], "intensity": 6.2831853}, {"type": "point", "intensity": 100},
              {"type": "spot", "intensity": 31.415927, "range": 20, "spot": {"outerConeAngle": 0.5}}]}}
            """);
        // A quarter turn about y takes −z to −x.
        foreach (var node in (string[])[
            """{"camera": 1, "translation": [4, 5, 6], "rotation": [0, 0.70710678118, 0, 0.70710678118]}""", """{"camera": 0}""",
            """{"rotation": [0, 0.70710678118, 0, 0.70710678118], "extensions": {"KHR_lights_punctual": {"light": 0}}}""",
            """{"translation": [1, 2, 3], "extensions": {"KHR_lights_punctual": {"light": 1}}}""",
            """{"extensions": {"KHR_lights_punctual": {"light": 2}}}""", """{"scale": [0, 0, 0], "camera": 0}"""])
        {
            document["nodes"].Add(JsonNode.Parse(node));
        }

        var scene = AssetLoader.Load(Write(document.Embedded())).Scene.Scene;
        var camera = scene.Camera!;
        Assert.Equal((new(4, 5, 6), Handedness.Right, Projection.Perspective), (camera.Position, scene.Handedness, scene.Projection));
        Near.Equal(new Matrix(-Vector.K, Vector.J, -Vector.I), camera.LocalAxes, 1e-7); // the quaternion is of floats
        Near.Equal(180 / Math.PI, camera.FieldOfView, 1e-6);
        var lights = scene.Lights.Select(static light => light.ToEmitter()!).ToArray();
        Near.Equal(-Vector.I, lights[0].Axis, 1e-7);
        Near.Equal(new Vector(2, 0.5, 0), lights[0].Radiance, 1e-6);
        // 100 candela at a distance of 4 are 100/16 lux, and white is π; a large range weakens by less than a thousandth.
        Near.Equal(100 / 16.0 / Math.PI, lights[1].Incoming(new(1, 2, -1), out _, out _).X, 1e-3);
        Assert.Equal((20, false, true), (lights[2].Range, lights[1].HasCone, lights[2].HasCone));
        Near.Equal(180 / Math.PI, lights[2].ConeAngle, 1e-5);
        Near.Equal(10.0 / 9, lights[2].Incoming(new(0, 0, -3), out _, out _).X, 1e-2);
        Assert.Empty(AssetLoader.Load(_folder["a.gltf"], new() { Placement = new(Vector.Zero, new(90, 0, 0), Vector.One) })
            .Scene.Scene.Lights);
        document["nodes"].RemoveAt(1);
        scene = AssetLoader.Load(Write(document.Embedded())).Scene.Scene;
        Assert.Equal((Projection.Orthographic, 4.0), (scene.Projection, scene.OrthographicHeight!.Value));
    }

    [Fact]
    public void Sparse_Accessor_HasItsReplacements()
    {
        var document = QuadDocument(4, [0, 1, 2, 0, 2, 3]);
        var indices = document.Add("SCALAR", 5123, 1, 2);
        var values = document.Add("VEC3", 5126, 3, 7, 8, 9);
        document["accessors"][0]!["sparse"] = JsonNode.Parse(string.Create(CultureInfo.InvariantCulture, $$$"""
            {"count": 1, "indices": {"bufferView": {{{indices}}}, "componentType": 5123}, "values": {"bufferView": {{{values}}}}}
            """));
        document["accessors"].RemoveAt(values);
        document["accessors"].RemoveAt(indices);
        Assert.Equal(new Vector(7, 8, 9), Read(document.Embedded()).Vertex(2));
    }

    [Fact]
    public void Materials_AndImages_AreThoseOfTheFile()
    {
        var document = QuadDocument(4, [0, 1, 2, 0, 2, 3]);
        var coordinates = document.Add("VEC2", 5126, 2, 0, 0, 1, 0, 1, 1, 0, 1);
        var colours = document.Add("VEC4", 5126, 4, 1, 1, 1, 1, 0.5, 0.25, 0, 1, 0, 0, 0, 1, 1, 1, 1, 1);
        var attributes = document["meshes"][0]!["primitives"]![0]!["attributes"]!.AsObject();
        attributes["TEXCOORD_0"] = coordinates;
        attributes["COLOR_0"] = colours;
        document["meshes"][0]!["primitives"]![0]!["material"] = 0;
        var png = new MemoryStream();
        PngWriter.Write(new PixelImage(2, 1, [255, 0, 0, 255, 0, 255, 0, 255]), png);
        var view = document.AddImage(png.ToArray());
        document.Root["images"] = JsonNode.Parse(string.Create(
            CultureInfo.InvariantCulture, $"[{{\"bufferView\": {view}, \"mimeType\": \"image/png\"}}]"));
        document.Root["textures"] = JsonNode.Parse("""[{"source": 0}]""");
        document["materials"].Add(JsonNode.Parse("""
            {"name": "Brass", "emissiveFactor": [0.5, 0, 0], "pbrMetallicRoughness":
              {"baseColorFactor": [0.5, 1, 1, 1], "baseColorTexture": {"index": 0}, "metallicFactor": 0.75, "roughnessFactor": 0.25}}
            """));
        File.WriteAllBytes(_folder["a.glb"], document.Binary());
        var file = AssetLoader.Load(_folder["a.glb"]);
        var model = file.Scene.Objects[0].Model;
        var material = Assert.Single(model.Materials).Value;
        Assert.Empty(file.Warnings);
        Assert.Equal(("Brass", 0.75, 0.25), (material.Name, material.Metalness!.Value, material.Roughness!.Value));
        Near.Equal(0.7353569, material.Diffuse.Red, 1e-6); // 0.5 of linear light in sRGB, by its curve
        Assert.Equal(new(0.5, 0, 0), material.Emission);
        Assert.Equal(png.ToArray(), material.Texture!.Contents);
        Assert.Equal("Brass", Assert.Single(model.Mesh.Groups).Material);
        Assert.DoesNotContain("map_Kd", MtlWriter.Write([material], _folder["a.mtl"]), StringComparison.Ordinal);
        // The first row of an image is at v = 0 in glTF, and at v = 1 here.
        Assert.Equal((double[])[0, 1, 1, 1, 1, 0, 0, 0], model.Mesh.TextureCoordinates);
        Near.Equal(0.7353569, model.Mesh.Colours[3], 1e-6);
    }

    /// <summary>The transform of a texture may name other coordinates than the texture does.</summary>
    [Fact]
    public void Pane_WithATextureThatIsMovedAndEnds_IsThatOfTheFile()
    {
        var document = QuadDocument(4, [0, 1, 2, 0, 2, 3]);
        var attributes = document["meshes"][0]!["primitives"]![0]!["attributes"]!.AsObject();
        attributes["TEXCOORD_0"] = document.Add("VEC2", 5126, 2, 9, 9, 9, 9, 9, 9, 9, 9);
        attributes["TEXCOORD_1"] = document.Add("VEC2", 5126, 2, 0, 0, 1, 0, 1, 1, 0, 1);
        document["meshes"][0]!["primitives"]![0]!["material"] = 0;
        var png = new MemoryStream();
        PngWriter.Write(new PixelImage(2, 1, [255, 0, 0, 255, 0, 255, 0, 255]), png);
        var view = document.AddImage(png.ToArray());
        document.Root["images"] = JsonNode.Parse(string.Create(
            CultureInfo.InvariantCulture, $"[{{\"bufferView\": {view}, \"mimeType\": \"image/png\"}}]"));
        document.Root["samplers"] = JsonNode.Parse("""[{"wrapS": 33071, "wrapT": 33071}, {}]""");
        document.Root["textures"] = JsonNode.Parse("""[{"source": 0, "sampler": 0}, {"source": 0, "sampler": 1}]""");
        document.Root["extensionsUsed"] = JsonNode.Parse(
            """["KHR_texture_transform", "KHR_materials_transmission", "KHR_materials_ior"]""");
        document["materials"].Add(JsonNode.Parse("""
            {"name": "Pane", "pbrMetallicRoughness": {"baseColorTexture":
              {"index": 0, "extensions": {"KHR_texture_transform": {"offset": [0.25, 0.5], "texCoord": 1}}}}, "normalTexture": {"index": 1},
             "extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.75}, "KHR_materials_ior": {"ior": 1.25}}}
            """));
        File.WriteAllBytes(_folder["a.glb"], document.Binary());
        var model = AssetLoader.Load(_folder["a.glb"]).Scene.Objects[0].Model;
        var material = Assert.Single(model.Materials).Value;
        Assert.Equal((0.25, 1.25), (material.Opacity, material.RefractiveIndex));
        Assert.Equal((true, false), (material.Texture!.IsClamped, material.NormalTexture!.IsClamped));
        Assert.Equal((double[])[0.25, 0.5, 1.25, 0.5, 1.25, -0.5, 0.25, -0.5], model.Mesh.TextureCoordinates);
    }

    [Fact]
    public void Text_WithFilesBesideIt_ReadsThemWithinItsFolder()
    {
        var (text, buffer) = QuadDocument(4, [0, 1, 2, 0, 2, 3]).Separate("my%20data.bin");
        Write(text);
        Assert.Contains("my data.bin\" is not found", Errors.MessageOf(() => MeshFile.Read(_folder["a.gltf"])), StringComparison.Ordinal);
        File.WriteAllBytes(_folder["my data.bin"], buffer);
        Assert.Equal(2, MeshFile.Read(_folder["a.gltf"]).FaceCount);
    }

    [Theory]
    [InlineData("", "the file is no valid glTF 2.0")]
    [InlineData("{}", "the file is no valid glTF 2.0")]
    [InlineData("{\"asset\": {\"version\": \"2.0\"}, \"extensionsRequired\": [\"KHR_draco_mesh_compression\"]}",
        "the file requires the extension KHR_draco_mesh_compression, which is not read")]
    public void Fault_IsOneLine(string text, string expected)
    {
        var fault = Assert.Throws<SourceException>(() => Read(text)).Diagnostic;
        Assert.StartsWith(expected, fault.Message, StringComparison.Ordinal);
        Assert.DoesNotContain('\n', fault.Message);
    }

    [Fact]
    public void Chunk_LongerThanItsFile_IsRefusedBeforeMemoryIsTaken()
    {
        var file = QuadDocument(4, [0, 1, 2, 0, 2, 3]).Binary();
        BitConverter.TryWriteBytes(file.AsSpan(12), 2_000_000_000);
        var path = _folder["a.glb"];
        File.WriteAllBytes(path, file);
        var before = GC.GetAllocatedBytesForCurrentThread();
        var message = Errors.MessageOf(() => MeshFile.Read(path));
        Assert.EndsWith("byte 12: a chunk of 2000000000 bytes is longer than the file", message, StringComparison.Ordinal);
        Assert.InRange(GC.GetAllocatedBytesForCurrentThread() - before, 0, 1_000_000);
    }

    [Fact]
    public void Skins_AreRefused_AndLinesLeftOut()
    {
        var document = QuadDocument(4, [0, 1, 2, 0, 2, 3]);
        document["meshes"][0]!["primitives"]!.AsArray().Add(JsonNode.Parse("""{"attributes": {"POSITION": 0}, "mode": 3}"""));
        var file = AssetLoader.Load(Write(document.Embedded()));
        Assert.Equal("points and lines are not shown: 1 primitives are left out", Assert.Single(file.Warnings).Message);
        document.Root["skins"] = JsonNode.Parse("""[{"joints": [0]}]""");
        document["nodes"][0]!["skin"] = 0;
        Assert.Contains("skins are not read", Errors.MessageOf(() => Read(document.Embedded())), StringComparison.Ordinal);
    }

    [Fact]
    public void Accessor_OfMoreCornersThanTheLimit_IsRefusedBeforeMemoryIsTaken()
    {
        var document = QuadDocument();
        document["accessors"][0] = JsonNode.Parse("""
            {"componentType": 5126, "count": 2000000000, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 0]}
            """);
        var before = GC.GetTotalAllocatedBytes();
        var fault = Assert.Throws<SourceException>(() => Read(document.Embedded())).Diagnostic;
        Assert.InRange(GC.GetTotalAllocatedBytes() - before, 0, 50_000_000);
        Assert.Equal("the meshes of the file have more than the limit of 100000000 corners", fault.Message);
        Assert.True(fault.IsLimitExceeded);
    }

    /// <summary>An accessor without bytes is all zeros, a hundred million of which fit into a line of text.</summary>
    [Fact]
    public void Accessor_OfMoreElementsThanBytes_IsRefused()
    {
        var document = QuadDocument();
        document["accessors"].Add(JsonNode.Parse("""{"componentType": 5126, "count": 49, "type": "VEC3"}"""));
        Assert.Contains(
            "an accessor has more elements than the buffers have bytes", Errors.MessageOf(() => Read(document.Embedded())),
            StringComparison.Ordinal);
        document["accessors"][1]!["count"] = 48;
        Assert.Equal(4, Read(document.Embedded()).VertexCount);
    }

    /// <summary>Vertices of primitives without colours are white, whichever come first; alpha counts where it blends.</summary>
    [Fact]
    public void ColoursAndOpacity_AreThoseOfThePrimitivesThatHaveThem()
    {
        var document = QuadDocument();
        var colours = document.Add("VEC3", 5126, 3, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0);
        document["meshes"][0]!["primitives"] = JsonNode.Parse($$"""
            [{"attributes": {"POSITION": 0}, "material": 0}, {"attributes": {"POSITION": 0, "COLOR_0": {{colours}} }, "material": 1},
             {"attributes": {"POSITION": 0} }]
            """);
        const string surface = "\"pbrMetallicRoughness\": {\"baseColorFactor\": [1, 1, 1, 0.25]}";
        document["materials"].Add(JsonNode.Parse($$"""{"name": "solid", {{surface}} }"""));
        document["materials"].Add(JsonNode.Parse($$"""{"name": "glass", "alphaMode": "BLEND", {{surface}} }"""));
        var model = (MeshModel)AssetLoader.Load(Write(document.Embedded())).Scene.Objects[0].Model;
        double[] white = [.. Enumerable.Repeat(1.0, 12)];
        Assert.Equal([.. white, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, .. white], model.Mesh.Colours.Select(static one => Math.Round(one, 9)));
        Assert.Equal((1, 0.25), (model.Materials["solid"].Opacity, model.Materials["glass"].Opacity));
    }

    [Fact]
    public void Materials_OfOneNameAndOfTheNumbersOfOthers_AreAllDifferent()
    {
        var document = QuadDocument();
        document["meshes"][0]!["primitives"] = new JsonArray();
        string?[] names = ["A", "A", "A 1", null, "material 3", "material 3 3"];
        foreach (var (i, name) in names.Index())
        {
            document["materials"].Add(new JsonObject
            {
                ["name"] = name, ["pbrMetallicRoughness"] = new JsonObject { ["baseColorFactor"] = new JsonArray(i / 8.0, 0, 0, 1) },
            });
            document["meshes"][0]!["primitives"]!.AsArray().Add(
                new JsonObject { ["attributes"] = new JsonObject { ["POSITION"] = 0 }, ["material"] = i });
        }

        var model = (MeshModel)AssetLoader.Load(Write(document.Embedded())).Scene.Objects[0].Model;
        Assert.Equal(
            ["A 0", "A 1 1", "A 1", "material 3 3 3", "material 3", "material 3 3"],
            model.Mesh.Groups.Select(static group => group.Material));
        Assert.Equal(
            Enumerable.Range(0, 6), model.Mesh.Groups.Select(
                group => (int)Math.Round(8 * model.Materials[group.Material].Diffuse.ToLinear().Red)));
    }

    [Fact]
    public void Bytes_ChangedAnywhere_AreReadOrRefused() => ChangeBytes(400);

    [Fact]
    [Trait("Category", "Soak")]
    public void ManyBytes_ChangedAnywhere_AreReadOrRefused() => ChangeBytes(2000);

    private void ChangeBytes(int count)
    {
        var original = QuadDocument(4, [0, 1, 2, 0, 2, 3]).Binary();
        var random = new Random(20261130);
        var refused = 0;
        for (var i = 0; i < count; i++)
        {
            var changed = original.ToArray();
            for (var n = random.Next(1, 4); n > 0; n--)
            {
                changed[random.Next(changed.Length)] = (byte)random.Next(256);
            }

            File.WriteAllBytes(_folder["a.glb"], random.Next(10) == 0 ? changed[..random.Next(changed.Length)] : changed);
            try
            {
                Assert.True(MeshFile.Read(_folder["a.glb"]).FaceCount <= 100);
            }
            catch (SourceException)
            {
                refused++;
            }
        }

        Assert.InRange(refused, count / 4, count - 2);
    }
}
