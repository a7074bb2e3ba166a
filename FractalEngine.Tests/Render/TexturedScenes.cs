using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Scenes;
using FractalEngine.Render.Images;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Render;

/// <summary>Meshes with materials, and texture files for them in a folder of the test's own.</summary>
internal sealed class TexturedScenes : IDisposable
{
    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    /// <summary>Writes an image file and returns a texture of it.</summary>
    public MaterialTexture CreateTexture(
        string name, int width, int height, Func<int, int, (byte Red, byte Green, byte Blue, byte Alpha)> colourAt)
    {
        var pixels = new List<byte>();
        for (var y = 0; y < height; y++)
        {
            for (var x = 0; x < width; x++)
            {
                var (red, green, blue, alpha) = colourAt(x, y);
                pixels.AddRange([red, green, blue, alpha]);
            }
        }

        ImageFile.SavePng(new(width, height, [.. pixels]), _folder[name]);
        return new(_folder[name]);
    }

    /// <summary>Writes a file that is no image, and returns a texture of it.</summary>
    public MaterialTexture CreateBrokenTexture(string name) => new(_folder.Write(name, "no image"));

    /// <summary>A square in the plane z = 0 that faces −z, with texture coordinates from corner to corner.</summary>
    public static Model CreateSquare(double half, Material material, string file = "square.obj") =>
        new MeshModel(TexturedSquare(half).WithGroups([new(0, 2, "", "", material.Name, 0)], ["a.mtl"]))
        {
            SourcePath = file,
            Materials = ImmutableDictionary<string, Material>.Empty.Add(material.Name, material),
        };

    public static Mesh TexturedSquare(double half) =>
        RenderScenes.Square(half).WithTextureCoordinates([0, 0, 1, 0, 0, 1, 1, 1], [0, 2, 1, 1, 2, 3]);

    /// <summary>A model whose faces all have the same material.</summary>
    public static Model WithMaterial(Mesh mesh, Material material) =>
        new MeshModel(mesh.WithGroups([new(0, mesh.FaceCount, "", "", material.Name, 0)], ["a.mtl"]))
        {
            SourcePath = "mesh.obj",
            Materials = ImmutableDictionary<string, Material>.Empty.Add(material.Name, material),
        };
}
