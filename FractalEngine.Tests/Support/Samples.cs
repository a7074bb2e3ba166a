using System.Text;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Tests.Support;

/// <summary>The paper's own files, small meshes and small fractals.</summary>
internal static class Samples
{
    public const string AppendixA = """
        # Scene Data

        # Camera attributes
        c (-48.761894, 25.567242, 64.429054) (-0.071402885, -2.4999454, 0) 60

         
        # Object file paths and transformations.
        o "SampleAsset1.obj" ((1, 1, 1), (90, 0, 30), #)

        o "SampleAsset2.obj" #
        """;

    public const string AppendixB = """
        # Fractal Data Object
        # Vector transformations
        v 1 1 -2
        v 1 -1 -2
        v -1 1 -2
        v -1 -1 -2
        v 0.5 0.5 0.5
        # Base Object
        x. "FractalBase.obj"
        # Transformation function indexing vertices above
        t.a. (a, #, 5)
        y. [#, t.1, t.2, t.3, t.4] x
        v 10 10 -10
        v 10 -10 -10
        v -10 10 -10
        v -10 -10 -10
        v 135 45 0
        v 135 -45 0
        v -135 45 0
        v -135 -45 0
        v 0.1, 0.1, 0.1
        u.a.b. (a, b, 14)
        # Recursive object
        z<x>. [#, u.6.10, u.7.11, u.8.12, u.9.13] y
        # Returns z as a finite fractal of depth 6.
        <$>. z 6
        """;

    /// <summary>A closed tetrahedron with outward faces, none of whose symmetries maps it to itself.</summary>
    public static Mesh Tetrahedron { get; } = new([0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0, 3], [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]);

    /// <summary>A single triangle, which is much faster than the tetrahedron, though symmetries map it to itself.</summary>
    public static Mesh Triangle { get; } = new([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2]);

    public static ParsedFractal ParseFractal(string text) => FractalParser.Parse(new("test.fdo", text));

    /// <summary>Parses a text as from a file: a byte order mark is none of its characters.</summary>
    public static ParsedFractal ParseFractalBytes(string text) =>
        FractalParser.Parse(SourceText.Decode(Encoding.UTF8.GetBytes(text), "test.fdo"));

    public static ParsedObj ParseObj(string text) => ObjOutcome.ParseChecked(text);

    public static Fractal AppendixBAt(int depth, Composition composition = Composition.Affine) =>
        new(ParseFractal(AppendixB).Description.WithDepth(depth) with { Composition = composition }, Triangle);

    /// <summary>Creates a fractal of one set that is repeated: S^depth.</summary>
    public static Fractal Repeated(int? depth, params Transformation[] set) =>
        new(new([new Repetition([new TransformationSet([.. set])], depth)]), Tetrahedron);

    public static Transformation Move(double x, double y, double z) => Transformation.Identity with { Position = new(x, y, z) };

    public static Transformation MoveAndScale(double x, double y, double z, double scale) =>
        new(new(x, y, z), Vector.Zero, scale * Vector.One);
}
