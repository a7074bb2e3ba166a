namespace FractalEngine.Tests.Support;

/// <summary>Texts of small files that many tests need.</summary>
internal static class SampleFiles
{
    /// <summary>OBJ text of a cube of side 1 around the origin: 8 vertices, 6 quads, 12 triangles.</summary>
    public const string Cube = """
        v -0.5 -0.5 -0.5
        v 0.5 -0.5 -0.5
        v 0.5 0.5 -0.5
        v -0.5 0.5 -0.5
        v -0.5 -0.5 0.5
        v 0.5 -0.5 0.5
        v 0.5 0.5 0.5
        v -0.5 0.5 0.5
        f 1 4 3 2
        f 5 6 7 8
        f 1 2 6 5
        f 4 8 7 3
        f 1 5 8 4
        f 2 3 7 6

        """;

    /// <summary>Creates FDO text of two maps of half the size, side by side: 2ⁿ instances at depth n.</summary>
    public static string Row(string depth) => $"""
        v -0.25 0 0
        v 0.25 0 0
        v 0.5 0.5 0.5
        t.a. (a, #, 3)
        x. "cube.obj"
        z<x>. [t.1, t.2] x
        <$>. z {depth}

        """;
}
