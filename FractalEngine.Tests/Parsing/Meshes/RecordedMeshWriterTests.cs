using System.Text;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Mtl;
using FractalEngine.Parsing.Wavefront;
using FractalEngine.Parsing.Wavefront.Writing;
using FractalEngine.Tests.Geometry;
using FractalEngine.Tests.Recorded;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Meshes;

/// <summary>Compares the meshes and materials that are written, or refused, with what is recorded.</summary>
public sealed class RecordedMeshWriterTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Meshes_ThatAreWritten_AreAsRecorded()
    {
        var parsed = ObjParser.Parse(new("t.obj", MeshTexts.Objs[0])).Mesh;
        var materials = MeshTexts.Mtls.SelectMany(text => MtlParser.Parse(new("t.mtl", text)).Materials.Values);
        var lines = new List<string>();
        foreach (string name in (string[])["", "two"])
        {
            using var stream = new MemoryStream();
            ObjMeshWriter.Write(parsed, stream, name);
            lines.AddRange(Encoding.UTF8.GetString(stream.ToArray()).Split('\n'));
        }

        lines.AddRange(MtlWriter.Write(materials.Select(material => material with
        {
            Texture = Absolute(material.Texture),
            OpacityTexture = Absolute(material.OpacityTexture),
            EmissionTexture = Absolute(material.EmissionTexture),
            BumpTexture = Absolute(material.BumpTexture),
            NormalTexture = Absolute(material.NormalTexture),
        }), _folder["t.mtl"]).Split('\n'));
        MeshGroup whole = new(0, parsed.FaceCount, "a", "b", "c", 0);
        (MeshGroup[] Groups, string[] Libraries)[] faulty =
        [
            ([new(0, 1, "a", "b", "c", 0)], []), ([whole with { ObjectName = "a\n" }], []), ([whole with { GroupName = "b #" }], []),
            ([whole with { Material = " c" }], []), ([whole with { SmoothingGroup = -1 }], []), ([whole], [""]), ([whole], ["a", "a"]),
            ([whole], ["a\\"]),
            ([whole with { FaceCount = 1 }, whole with { FirstFace = 1, FaceCount = parsed.FaceCount - 1 }], []),
            ([whole with { FaceCount = 0 }, whole], []),
            ([whole with { FaceCount = 1, ObjectName = "" }, whole with { FirstFace = 1, FaceCount = parsed.FaceCount - 1,
            SmoothingGroup = 2 }], ["a", "b"]), ([], []),
        ];
        Mesh[] meshes = [new([], []), .. faulty.Select(one => parsed.WithGroups([.. one.Groups], [.. one.Libraries]))];
        lines.AddRange(meshes.Select(mesh => MeshTexts.Outcome(_folder.Path, () =>
        {
            using var stream = new MemoryStream();
            ObjMeshWriter.Write(mesh, stream, "n");
            return Encoding.UTF8.GetString(stream.ToArray());
        })));
        Material plain = new("a");
        Material[] materialFaults =
        [
            plain with { Name = "" }, plain with { Name = "a #b" }, plain with { Diffuse = new(double.NaN, 0, 0) },
                plain with { Ambient = new(0, double.NaN, 0) }, plain with { Specular = new(0, 0, double.NaN) },
            plain with { Emission = new(double.PositiveInfinity, 0, 0) }, plain with { SpecularExponent = double.NaN },
                plain with { Opacity = 1.1 }, plain with { Opacity = -0.1 }, plain with { Roughness = double.NaN },
            plain with { Metalness = 0.5, Roughness = 0.25 }, plain with { Texture = new("a\nb") },
                plain with { Texture = new("/a\\b") }, plain with { Texture = new(_folder["-a"]) },
            plain with { Texture = new("/a") { BumpFactor = double.NaN } }, plain with { Texture = new("/a") { Scale = (double.NaN,
                1) } }, plain with { Texture = new("/a") { Offset = (1, double.NaN) } },
        ];
        lines.AddRange(materialFaults.Select(material => MeshTexts.Outcome(_folder.Path, () => MtlWriter.Write([material],
            _folder["t.mtl"]))));
        RecordedText.Check("meshes-written.txt", lines);
    }

    [Fact]
    public void SceneMaterials_WithoutAnArgument_NameIt()
    {
        Assert.Equal("scene", Assert.Throws<ArgumentNullException>(() => SceneMaterials.Of(null!)).ParamName);
        var materials = SceneMaterials.Of(LoadedScene.Of(new()));
        Assert.Equal("placed", Assert.Throws<ArgumentNullException>(() => materials.NameOf(null!, "")).ParamName);
        Assert.Equal("stream", Assert.Throws<ArgumentNullException>(() => materials.Write(null!, "/a.mtl")).ParamName);
        Assert.True(SceneMaterials.CanBeNamed("a.mtl") && !SceneMaterials.CanBeNamed("") && !SceneMaterials.CanBeNamed("a #.mtl"));
    }

    private MaterialTexture? Absolute(MaterialTexture? texture) => texture is null ? null : texture with { Path = _folder[texture.Path] };
}
