using System.Numerics;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Parsing;
using FractalEngine.Tests.Oracles.Graphs.Expansion;
using FractalEngine.Tests.Oracles.Graphs.Models;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Oracles.Graphs;

/// <summary>What sums and joint recursives mean: counts by hand, and files that say the same in another way.</summary>
public sealed class GraphMeaningTests : IDisposable
{
    private const string Maps = """
        g. ((0, 1.5, 0), (0, 10, 0), (0.5))
        s. ((1, 0.2, 0.1), (0, 20, 30), (0.6, 0.5, 0.4))
        m. ((-1, 0, 0.3), #, (-0.7, 0.7, 0.7))
        turn. (#, (0, 120, 0), #)
        up = (0, 1, 0)
        out. ((0.5, 0.2, 0), (0, 0, 40), (0.6))
        side.a. (up, (0, 0, a), (0.7))
        left = 30
        right = -30
        skew.matrix (0.5, 0, 0.1) (0.2, 0.6, 0) (0, 0, 0.4) (0, 1, 0)

        """;

    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    // Faces: 12 of a box, 2 of a plate, 4 of a tetrahedron, 320 of a ball.
    [Theory]
    [InlineData("<$>. box + plate", 2, 14)]
    [InlineData("<$>. box + box", 2, 24)]
    [InlineData("<$>. [g., s.] box + plate", 3, 26)]
    [InlineData("<$>. [g., s.] (box + plate)", 4, 28)]
    [InlineData("<$>. [g., s.] (box + [m., g., s.] plate) + tetrahedron", 9, 40)]
    [InlineData("<$>. ((box) + (plate + ball))", 3, 334)]
    [InlineData("<$>. [g.] [turn.^0..2] box + [s.^-1..1 * turn.^2..3] plate", 9, 48)]
    // A constant at each of the levels but the last.
    [InlineData("z<box>. [g.] box + [turn.^0..2] [s.] box + plate\n<$>. z 0", 1, 12)]
    [InlineData("z<box>. [g.] box + [turn.^0..2] [s.] box + plate\n<$>. z 1", 5, (4 * 12) + 2)]
    [InlineData("z<box>. [g.] box + [turn.^0..2] [s.] box + plate\n<$>. z 4", 256 + 85, (256 * 12) + (85 * 2))]
    [InlineData("z<box>. plate + [g.] (box + [s.] (box + tetrahedron))\n<$>. [turn.^0..1] z 3 + z 0", 45, (2 * ((8 * 12) + (7 * 6))) + 12)]
    // Two calls of itself, of which one is no map.
    [InlineData("z<box>. box + [g.] box\n<$>. z 5", 32, 32 * 12)]
    // Young become adults, and adults have young: 1, 1, 2, 3, 5, 8.
    [InlineData("young<box>, adult<plate>. [g.] plate, [s.] box + [g.] plate\n<$>. young 5", 8, (3 * 12) + (5 * 2))]
    [InlineData("young<box>, adult<plate>. [g.] plate, [s.] box + [g.] plate\n<$>. young 2 + adult 0", 3, 12 + 4)]
    // Leaders: 1 call of itself and 5 boughs; boughs: 2; a constant at each.
    [InlineData(
        "leader<box>, bough<plate>. [g.] box + [turn.^0..4] [out.] plate + ball, [side.left, side.right] plate + ball\n<$>. leader 3",
        1 + 35 + 23, 12 + (35 * 2) + (23 * 320))]
    // The third calls the first alone, which calls the second.
    [InlineData("a<box>, b<plate>, c<ball>. [g.] plate, [s.] ball + ball, [m.] box\n<$>. a 3", 2, 24)]
    [InlineData("a<box>, b<plate>, c<ball>. [g.] plate, [s.] ball + ball, [m.] box\n<$>. a 4", 2, 4)]
    // Recursives in others: a constant, and at depth 0.
    [InlineData("z<box>. [g.] box + plate\nw<ball>. [s., m.] ball + z 2\n<$>. w 2", 4 + (3 * 3), (4 * 320) + (3 * 16))]
    [InlineData("z<box>. [g.] box + plate\nx. [s., m.] z 1\nw<x>. [g.] x + x\n<$>. w 2", 16, 8 * 14)]
    public void Counts_OfFiles_AreThoseByHand(string text, int instances, int faces)
    {
        var fractal = Read(text);
        Assert.Equal((BigInteger?)instances, fractal.InstanceCount);
        Assert.Equal((BigInteger?)faces, fractal.FaceCount);
    }

    [Theory]
    [InlineData("<$>. [g.] box + plate", "<$>. plate + ([g.] box)")]
    [InlineData("<$>. [g., s.] (box + plate)", "<$>. [g.] box + [g.] plate + [s.] box + [s.] plate")]
    [InlineData("<$>. [g.] [s.] (box + [m.] plate)", "<$>. [g. * s.] box + [g. * s. * m.] plate")]
    [InlineData(
        "z<box>. [g.] box + [turn.^0..2] [s.] box + plate\n<$>. z 2",
        "a. [g.] box + [turn.^0..2] [s.] box + plate\n<$>. [g.] a + [turn.^0..2] [s.] a + plate")]
    [InlineData(
        "leader<box>, bough<plate>. [g.] box + [turn.^0..4] [out.] plate + ball, [side.left, side.right] plate + ball\n<$>. leader 2",
        """
        l. [g.] box + [turn.^0..4] [out.] plate + ball
        m1. [side.left, side.right] plate + ball
        <$>. [g.] l + [turn.^0..4] [out.] m1 + ball
        """)]
    // The base stands at depth 0 alone; what it is made of is no call.
    [InlineData("x. [s.] (box + plate)\nz<x>. [g.] x + box\n<$>. z 2", "x. [s.] (box + plate)\n<$>. [g. * g.] x + [g.] box + box")]
    [InlineData("z<box>. [skew.] box + plate\n<$>. z 3", "<$>. [skew.^3] box + [skew.^0..2] plate")]
    // A set may be empty.
    [InlineData("<$>. box + [] ball", "<$>. box")]
    [InlineData("z<box>. [g.] box + [] box + plate\n<$>. z 2", "<$>. [g.^2] box + [g.^0..1] plate")]
    // Sets on the base by another name are a call where there are no sums, and plain objects elsewhere.
    [InlineData("x. box\ny. [s., m.] x\nz<x>. [g.] y\n<$>. z 2", "<$>. [g.] [s., m.] [g.] [s., m.] box")]
    [InlineData("x. box\na<x>. [s.] x\nz<x>. [g.] a 2\n<$>. z 2", "<$>. [g. * s.^2 * g. * s.^2] box")]
    [InlineData("x. box\ny. [s., m.] x\nz<x>. [g.] y + [s.] x\n<$>. z 2", "<$>. [g., s. * g.] [s., m.] box + [s.^2] box")]
    [InlineData(
        "x. box\na<x>. [s.] x + plate\nz<x>. [g.] a 2 + [m.] x\n<$>. z 2",
        "<$>. [g., m. * g.] ([s.^2] box + [s.^0..1] plate) + [m.^2] box")]
    public void Answers_OfFilesThatSayTheSame_AreEqual(string text, string other)
    {
        var (fractal, expected) = (Read(text), Read(other));
        Assert.Equal((expected.InstanceCount, expected.FaceCount), (fractal.InstanceCount, fractal.FaceCount));
        var (collider, reference) = (Collider.For(fractal), Collider.For(expected));
        Seeded.Run(50, random =>
        {
            var position = random.Vector(3);
            // Coordinates of up to ten.
            Near.Equal(reference.FindClosest(position).Distance, collider.FindClosest(position).Distance, 1e-11);
        });
    }

    [Fact]
    public void Files_AsTerms_AreTheirResults()
    {
        _folder.Write(".asset-root", "");
        _folder.Write("sub/deep/c.fdo", "a. ((0, 1, 0), #, (0.5))\nx. plate\nz<x>. [a.] x + tetrahedron\n<$>. z 2\n");
        _folder.Write("sub/b.fdo", "a. ((2, 0, 0), #, #)\nz. [#, a.] \"deep/c.fdo\"\n<$>. z + \"../d.fdo\"");
        _folder.Write("d.fdo", "<$>. ball");
        var fractal = Read("a. ((0, 0, 5), #, #)\nx. box\n<$>. [a.] \"sub/b.fdo\" + x + \"d.fdo\" + [a., #] \"d.fdo\"");
        var expected = Read("""
            a. ((0, 0, 5), #, #)
            b. ((2, 0, 0), #, #)
            c. ((0, 1, 0), #, (0.5))
            <$>. [a.] ([#, b.] ([c.^2] plate + tetrahedron + [c.] tetrahedron) + ball) + box + ball + [a.] ball + ball
            """);
        Assert.Equal((11, (2 * 10) + 12 + (4 * 320)), ((int)fractal.InstanceCount!, (int)fractal.FaceCount!));
        var (collider, reference) = (Collider.For(fractal), Collider.For(expected));
        Seeded.Run(50, random =>
        {
            var position = random.Vector(6);
            Near.Equal(reference.FindClosest(position).Distance, collider.FindClosest(position).Distance, 1e-11);
        });
    }

    /// <summary>Without a depth a recursive has no end. Of maps that shrink to a tenth nothing is left below level 12.</summary>
    [Theory]
    [InlineData("z<box>. [s., r.] box + plate\n<$>. z")]
    [InlineData("z<box>, w<plate>. [s.] box + [r.] plate + ball, [s.] box + tetrahedron\n<$>. [q.] z + cone")]
    [InlineData("z<box>. [s., r.] box\n<$>. z + [q.] (z + tetrahedron)")]
    public void ClosestPoints_OfInfiniteFiles_AreThoseOfTheTwelfthLevel(string lines)
    {
        const string Tiny = """
            s. ((0.9, 0, 0), #, (0.05))
            r. ((-0.5, 1, 0.3), (0, 40, 0), (0.08, 0.07, -0.06))
            q. ((0, 0, 2), (30, 0, 0), #)

            """;
        var fractal = ReadText(Tiny + lines);
        Assert.Null(fractal.InstanceCount);
        var collider = Collider.For(fractal);
        var finite = lines.Replace(" z\n", " z 12\n").Replace(". z", ". z 12").Replace("] z ", "] z 12 ").Replace("(z ", "(z 12 ");
        var reference = Collider.For(ReadText(Tiny + finite));
        Seeded.Run(50, random =>
        {
            var position = random.Vector(3);
            Near.Equal(reference.FindClosest(position).Distance, collider.FindClosest(position).Distance, 1e-11);
        });
    }

    /// <summary>The infinite fractal against all triangles of the twelfth level.</summary>
    [Fact]
    public void ClosestPoints_OfAnInfiniteFile_AreThoseOfAllTriangles()
    {
        MapLeaf.Placement small = new(new(0.9, 0, 0), null, new(0.05, 0.05, 0.05));
        MapLeaf.Placement turned = new(new(-0.5, 1, 0.3), new(0, 40, 0), new(0.08, 0.07, -0.06));
        ObjectTerm body = new ObjectTerm.Sum(
        [
            new ObjectTerm.Mapped([new([new(small)]), new([new(turned)])], new ObjectTerm.Named("box")),
            new ObjectTerm.Named("plate"),
        ]);
        GraphFile file = new("main.fdo", [new GraphDeclaration.Group([new("z", "box", body)])], new ObjectTerm.AtDepth("z", null));
        var soup = new TriangleSoup(ModelExpansion.TryExpand(file, 10_000, 100_000, infiniteDepth: 12)!.Value);
        var collider = Collider.For(FractalFile.Read(GraphTexts.Of(file).WriteTo(_folder)));
        Seeded.Run(50, random =>
        {
            var position = random.Vector(2);
            Near.Equal(soup.FindClosest(position).Distance, collider.FindClosest(position).Distance, 1e-12);
        });
    }

    [Theory]
    [InlineData("<$>. box + plate")]
    [InlineData("<$>. box + box")]
    [InlineData("<$>. [g.] box + [s., skew.] (plate + [m.] box)")]
    [InlineData("z<box>. [g.] box + [s., m.] box + plate\n<$>. [#] z 0 + ball")]
    [InlineData("z<box>. [g.] box + [s., m.] box + plate\n<$>. z 4 + z 2")]
    [InlineData("z<box>. [g.] box + plate\nw<ball>. [s., m.] ball + z 2\n<$>. w 2")]
    [InlineData("z<box>, w<plate>. [s.] box + [skew.] plate + ball, [s.] box + tetrahedron\n<$>. [g.] z + cone")]
    // Calls of which an empty set leaves nothing, and recursives that are nothing but their bases.
    [InlineData("z<ball>. cone + [g.] ball + [] [#] ball\n<$>. z 2")]
    [InlineData("z<ball>. cone + [] [#] ball\n<$>. z 2")]
    [InlineData("z<box>, w<ball>. [m.] box + ball, box + [] [g.] ball\n<$>. z 2")]
    [InlineData("z<box>, w<plate>. box, plate + [g.] box\n<$>. z 2 + w 2")]
    [InlineData("z<box>, w<plate>. box, tetrahedron + cone\n<$>. z 0")]
    [InlineData("z<box>, w<plate>. box, tetrahedron + cone\n<$>. z 3")]
    public void Files_ThatAreWritten_ReadBackEqual(string text)
    {
        var fractal = Read(text);
        FractalFile.Write(_folder["written.fdo"], fractal);
        var read = FractalFile.Read(_folder["written.fdo"]);
        Assert.True(fractal.Equals(read), File.ReadAllText(_folder["written.fdo"]));
    }

    private Fractal Read(string text) => ReadText(Maps + text);

    private Fractal ReadText(string text) => FractalFile.Read(_folder.Write("main.fdo", text.ReplaceLineEndings("\n")));
}
