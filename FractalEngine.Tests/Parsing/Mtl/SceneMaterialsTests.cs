using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Mtl;

namespace FractalEngine.Tests.Parsing.Mtl;

/// <summary>The files that the materials of a scene name.</summary>
public sealed class SceneMaterialsTests
{
    [Fact]
    public void Textures_OfAllKinds_AreListedOnceEach()
    {
        var material = new Material("all")
        {
            Texture = new("/a.png"), OpacityTexture = new("/b.png"), EmissionTexture = new("/c.png"), BumpTexture = new("/d.png"),
            NormalTexture = new("/e.png"),
        };
        var other = new Material("other") { NormalTexture = new("/f.png"), BumpTexture = new("/a.png") };
        var mesh = new Mesh([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2, 2, 1, 0])
            .WithGroups([new(0, 1, "", "", "all", 0), new(1, 1, "", "", "other", 0)], []);
        var model = new MeshModel(mesh)
        {
            Materials = ImmutableDictionary<string, Material>.Empty.Add("all", material).Add("other", other),
        };
        var materials = SceneMaterials.Of(LoadedScene.Of(new() { Objects = [new(model), new(model)] }));
        Assert.Equal(["/a.png", "/b.png", "/c.png", "/d.png", "/e.png", "/f.png"], materials.Textures.Order(StringComparer.Ordinal));
        Assert.Equal(2, materials.Count);
    }
}
