using System.Collections.Immutable;
using FractalEngine.Render.Windowing;

namespace FractalEngine.App.Window;

/// <summary>A small fractal to begin with, whose numbers are then turned in the window.</summary>
/// <param name="Key">The key that chooses it.</param>
/// <param name="Name">Name of the file that is proposed, without its ending.</param>
/// <param name="Help">What it is, for the user.</param>
/// <param name="Text">Text of the fractal, with <see cref="MeshMark"/> in the place of the mesh's file name.</param>
/// <param name="MeshText">OBJ text of the base mesh.</param>
internal sealed record FractalTemplate(Key Key, string Name, string Help, string Text, string MeshText)
{
    private const string MeshMark = "MESH";

    private const string Prism =
        """
        # A piece of a trunk: a hexagonal prism from y = 0 to y = 1 that narrows to 0.7 of its width.
        v 0 0 0.09
        v 0.0779 0 0.045
        v 0.0779 0 -0.045
        v 0 0 -0.09
        v -0.0779 0 -0.045
        v -0.0779 0 0.045
        v 0 1 0.063
        v 0.0546 1 0.0315
        v 0.0546 1 -0.0315
        v 0 1 -0.063
        v -0.0546 1 -0.0315
        v -0.0546 1 0.0315
        f 1 2 8 7
        f 2 3 9 8
        f 3 4 10 9
        f 4 5 11 10
        f 5 6 12 11
        f 6 1 7 12
        f 7 8 9 10 11 12
        f 6 5 4 3 2 1

        """;

    private const string Triangle =
        """
        # A triangle that is a little thick.
        v -0.5 -0.433 -0.02
        v 0.5 -0.433 -0.02
        v 0 0.433 -0.02
        v -0.5 -0.433 0.02
        v 0.5 -0.433 0.02
        v 0 0.433 0.02
        f 1 3 2
        f 4 5 6
        f 1 2 5 4
        f 2 3 6 5
        f 3 1 4 6

        """;

    private const string Cube =
        """
        # A cube of side 1 around the origin.
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

    /// <summary>All templates, in the order of the question.</summary>
    public static readonly ImmutableArray<FractalTemplate> All =
    [
        new(Key.T, "tree", "a tree: a trunk with branches",
            $"""
            # A tree: each piece of the trunk carries the next one and three branches, and each branch is a tree again.
            x. "{MeshMark}"
            # 1: where the trunk goes on. 2 to 4: where the branches leave.
            v 0 1 0
            v 0 0.6 0
            v 0 0.75 0
            v 0 0.9 0
            # 5 to 8: how they lean, in degrees about x, y and z.
            v 0 60 6
            v 0 10 50
            v 0 130 46
            v 0 250 42
            # 9: the trunk narrows. 10: branches are thinner.
            v 0.7 0.7 0.7
            v 0.55 0.55 0.55
            t.a.b.c. (a, b, c)
            z<x>. [#, t.1.5.9, t.2.6.10, t.3.7.10, t.4.8.10] x
            # The depth: how often it branches.
            <$>. z 5

            """, Prism),
        new(Key.S, "triangle", "a Sierpinski triangle: three halves of itself",
            $"""
            # A Sierpinski triangle: three copies of half the size.
            x. "{MeshMark}"
            # 1 to 3: where the copies are.
            v -0.25 -0.2165 0
            v 0.25 -0.2165 0
            v 0 0.2165 0
            # 4: how large they are.
            v 0.5 0.5 0.5
            t.a. (a, #, 4)
            z<x>. [t.1, t.2, t.3] x
            # The depth: how often each copy is replaced by three.
            <$>. z 6

            """, Triangle),
        new(Key.C, "cubes", "cubes on the sides of cubes",
            $"""
            # A cube that carries a smaller one on five of its sides, and so on.
            x. "{MeshMark}"
            # 1 to 5: where they stand.
            v 0.75 0 0
            v -0.75 0 0
            v 0 0.75 0
            v 0 0 0.75
            v 0 0 -0.75
            # 6: how large they are. 7: how they are turned, in degrees.
            v 0.5 0.5 0.5
            v 0 0 0
            t.a. (a, 7, 6)
            z<x>. [#, t.1, t.2, t.3, t.4, t.5] x
            # The depth: how often each cube carries others.
            <$>. z 4

            """, Cube),
    ];

    /// <summary>Returns the text of the fractal.</summary>
    /// <param name="meshFile">File name of the base mesh, in the same folder.</param>
    public string TextWith(string meshFile) => Text.Replace(MeshMark, meshFile, StringComparison.Ordinal);
}
