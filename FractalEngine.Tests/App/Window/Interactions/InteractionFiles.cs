using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window.Interactions;

/// <summary>The files of all interactions.</summary>
internal static class InteractionFiles
{
    public const string Scene =
        """
        # kept
        c (0, 0, -8) (0, 0, 0) 60
        o "cube.obj" ((0, 0, 0), #, #) name "left" colour (0.8, 0.3, 0.2)
        # between
        o "cube.obj" ((3, 0, 0), #, #) name "right"

        """;

    public const string Row =
        """
        # kept: three cubes
        v  1.5   0 0
        v 0.5 0.5 0.5
        t.a.b. (a, #, b)
        x. "cube.obj"
        z<x>. [#, t.1.2] x
        <$>. z   3
        # kept too

        """;

    /// <summary>Writes a mesh of half a million triangles.</summary>
    public static void WriteLarge(string path)
    {
        using var writer = new StreamWriter(path) { NewLine = "\n" };
        for (var i = 0; i < 250_000; i++)
        {
            writer.WriteLine(FormattableString.Invariant($"v {i % 500} {i / 500} {i * 7 % 5}"));
        }

        for (var i = 0; i < 249_000; i++)
        {
            writer.WriteLine(FormattableString.Invariant($"f {i + 1} {i + 2} {i + 502} {i + 501}"));
        }
    }

    public static readonly (string Name, string Text)[] All =
    [
        ("cube.obj", "mtllib missing.mtl\nusemtl missing\n" + SampleFiles.Cube),
        ("scene.sdo", Scene),
        ("spin.sdo", "c (0, 0, -8) (0, 0, 0) 60\no \"cube.obj\" # name \"spinner\" moving spin (0.3, 0.5, 0.7)\n"),
        ("inner/cube.obj", SampleFiles.Cube),
        ("open.obj", "mtllib missing.mtl\nusemtl missing\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ("row.fdo", Row),
        ("other.fdo", SampleFiles.Row("4").Replace("\r", "", StringComparison.Ordinal)),
        ("two.sdo", "c (0, 0, -8) (0, 0, 0) 60\no \"row.fdo\" ((0, 0, 0), #, #)\no \"other.fdo\" ((0, 2, 0), #, #)\n"),
        ("lit.sdo", Scene + "light ambient (1, 1, 1) 0.2\nlight directional (1, -2, 1) (1, 1, 1) 0.7\n"),
        // Two pixels, whose bytes are text.
        ("field.hdr", "#?RADIANCE\n\n-Y 1 +X 2\n@@@\u007f`@ \u007f"),
        ("field.sdo", Scene + "sky \"field.hdr\" scale 2\n"),
        ("many.sdo", "c (0, 0, -8) (0, 0, 0) 60\n"
            + string.Concat(Enumerable.Range(0, 60).Select(i => $"o \"cube.obj\" (({3 * i}, 0, 0), #, #) name \"cube {i}\"\n"))),
        // All of a cube, down to no end: wherever a camera flies, it meets a surface.
        ("endless.fdo", """
            v -0.25 -0.25 -0.25
            v 0.25 -0.25 -0.25
            v -0.25 0.25 -0.25
            v 0.25 0.25 -0.25
            v -0.25 -0.25 0.25
            v 0.25 -0.25 0.25
            v -0.25 0.25 0.25
            v 0.25 0.25 0.25
            v 0.5 0.5 0.5
            t.a. (a, #, 9)
            x. "cube.obj"
            z<x>. [t.1, t.2, t.3, t.4, t.5, t.6, t.7, t.8] x
            <$>. z

            """),
    ];
}
