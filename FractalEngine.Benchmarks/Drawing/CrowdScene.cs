using System.Globalization;
using System.Text;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Wavefront.Writing;
using FractalEngine.Render.Images;

namespace FractalEngine.Benchmarks.Drawing;

/// <summary>
/// A scene of 400 objects of four files, written into a temporary folder: wooden crates, spheres whose poles are fans of degenerate
/// triangles, pillars, and behind the camera knots of many faces. About half of the objects lie outside the frustum.
/// </summary>
internal sealed class CrowdScene : IDisposable
{
    private const int ObjectsPerSide = 20;
    private const double Spacing = 1.6;
    private const int SphereRings = 24;
    private const double SphereRadius = 0.6;
    private const int TextureSize = 512;
    private const int KnotFaces = 40_000;

    private static readonly int[][] BoxQuads = [[1, 3, 4, 2], [6, 8, 7, 5], [5, 7, 3, 1], [2, 4, 8, 6], [3, 7, 8, 4], [5, 1, 2, 6]];

    private readonly DirectoryInfo _folder = Directory.CreateTempSubdirectory("crowd");

    /// <summary>Writes the files of the scene.</summary>
    public CrowdScene()
    {
        ImageFile.SavePng(new(TextureSize, TextureSize, CreateWoodPixels()), PathOf("wood.png"));
        File.WriteAllText(PathOf("wood.mtl"), "newmtl wood\nKd 1 1 1\nmap_Kd wood.png\n");
        File.WriteAllText(PathOf("crate.obj"), CreateBoxObj(1));
        File.WriteAllText(PathOf("pillar.obj"), CreateBoxObj(3));
        WriteMesh(CreateSphere(), "ball");
        WriteMesh(MeshGenerators.Create("torus-knot", 0, KnotFaces), "knot");
        File.WriteAllText(Path, CreateSceneText());
    }

    /// <summary>Path of the scene's file.</summary>
    public string Path => PathOf("crowd.sdo");

    /// <inheritdoc/>
    public void Dispose() => _folder.Delete(recursive: true);

    private string PathOf(string file) => System.IO.Path.Combine(_folder.FullName, file);

    private void WriteMesh(Mesh mesh, string name)
    {
        using var stream = File.Create(PathOf(name + ".obj"));
        ObjMeshWriter.Write(mesh, stream, name);
    }

    private static string CreateSceneText()
    {
        var text = new StringBuilder("c (0.8, 2.2, -1.6) (-0.2, 0, 0) 60\n");
        for (var i = 0; i < ObjectsPerSide * ObjectsPerSide; i++)
        {
            var x = Spacing * ((i % ObjectsPerSide) - (ObjectsPerSide / 2));
            var z = Spacing * ((i / ObjectsPerSide) - (ObjectsPerSide / 2));
            var file = z < -3 * Spacing && i % 5 == 0 ? "knot" : (i % 3) switch { 0 => "crate", 1 => "ball", _ => "pillar" };
            text.AppendLine(CultureInfo.InvariantCulture, $"o \"{file}.obj\" (({x:R}, 0, {z:R}), (0, {i * 37 % 90}, 0), #)");
        }

        return text.ToString();
    }

    private static string CreateBoxObj(double height)
    {
        var text = new StringBuilder("mtllib wood.mtl\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n");
        for (var i = 0; i < 8; i++)
        {
            text.AppendLine(CultureInfo.InvariantCulture, $"v {(i & 1) - 0.5} {height * (i >> 1 & 1)} {(i >> 2) - 0.5}");
        }

        text.AppendLine("usemtl wood");
        foreach (var quad in BoxQuads)
        {
            text.AppendLine(CultureInfo.InvariantCulture, $"f {quad[0]}/1 {quad[1]}/4 {quad[2]}/3");
            text.AppendLine(CultureInfo.InvariantCulture, $"f {quad[0]}/1 {quad[2]}/3 {quad[3]}/2");
        }

        return text.ToString();
    }

    /// <summary>Creates rings of quads. Those at the poles have two vertices in one place.</summary>
    private static Mesh CreateSphere()
    {
        const int columns = 2 * SphereRings;
        var positions = new List<double>();
        var indices = new List<int>();
        for (var ring = 0; ring <= SphereRings; ring++)
        {
            var (sine, cosine) = double.SinCosPi((double)ring / SphereRings);
            for (var column = 0; column < columns; column++)
            {
                var (acrossSine, acrossCosine) = double.SinCosPi((double)column / SphereRings);
                positions.AddRange([SphereRadius * sine * acrossCosine, SphereRadius * (1 + cosine), SphereRadius * sine * acrossSine]);
                if (ring < SphereRings)
                {
                    var a = (ring * columns) + column;
                    var b = (ring * columns) + ((column + 1) % columns);
                    indices.AddRange([a, b, a + columns, b, b + columns, a + columns]);
                }
            }
        }

        return new([.. positions], [.. indices]);
    }

    private static byte[] CreateWoodPixels()
    {
        var pixels = new byte[4 * TextureSize * TextureSize];
        for (var i = 0; i < TextureSize * TextureSize; i++)
        {
            var (y, x) = Math.DivRem(i, TextureSize);
            var grain = 0.75 + (0.25 * Math.Sin((0.09 * x) + (3 * Math.Sin(0.013 * y))));
            pixels[4 * i] = (byte)(200 * grain);
            pixels[(4 * i) + 1] = (byte)(140 * grain);
            pixels[(4 * i) + 2] = (byte)(80 * grain);
            pixels[(4 * i) + 3] = byte.MaxValue;
        }

        return pixels;
    }
}
