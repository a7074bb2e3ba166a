using System.Collections.Immutable;
using System.Globalization;
using System.Text;
using FractalEngine.Core;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;
using BigInteger = System.Numerics.BigInteger;

namespace FractalEngine.Tests.Parsing.Fdo;

/// <summary>Sums, recursives that call each other, and fractal files as terms.</summary>
public sealed class SeveralMeshesTests : IDisposable
{
    private const string Head = "move. ((3, 0, 0), #, #)\nhalf. (#, #, (0.5))\nturn. (#, (0, 90, 0), #)\n";

    private const string Tree = """
        lean = 40 from 0 to 90
        g. ((0, 1, 0), (0, 60, 9), (0.7))
        s. ((0, 0.7, 0), (0, 0, lean), (0.6))
        turn. (#, (0, 120, 0), #)
        z<ball>. [g.] ball + [turn.^0..2] [s.] ball + box
        <$>. z 4
        """;

    private readonly TemporaryFolder _folder = new();

    public void Dispose() => _folder.Dispose();

    private Fractal Read(string text, string name = "a.fdo")
    {
        File.WriteAllText(_folder[name], text);
        return FractalFile.Read(_folder[name]);
    }

    [Theory]
    [InlineData("<$>. box + ball", 1, 1)]
    [InlineData("<$>. box + [move.^1..3] ball", 1, 3)]
    [InlineData("<$>. [turn.^0..1] (box + [move.] (ball + box))", 4, 2)]
    [InlineData("y. (box + ball)\n<$>. y + y", 2, 2)]
    [InlineData("y. ((box + ball) + ball)\n<$>. [move., half.] y", 2, 4)]
    [InlineData("b. box\nz<b>. [half.] b + ball\n<$>. z 3", 1, 3)]
    [InlineData("b. box\nz<b>. [half.] b + ball\n<$>. z 0", 1, 0)]
    [InlineData("b. box\nz<b>. [half.] b + [move.] b + ball\n<$>. z 3", 8, 7)]
    [InlineData("b. box\nz<b>. [turn.^0..1] ([half.] b + [move.] b) + ball\n<$>. z (1 + 1)", 16, 5)]
    [InlineData("b. box\nc. ball\nz<b>, w<c>. [half.] b + [half.] c, [move.] b\n<$>. z 5 + w 0", 8, 6)]
    [InlineData("b. box\nc. ball\nz<b>, w<c>. [half.] c, [move.] b + c\n<$>. w 3", 2, 3)]
    [InlineData("b. box\nz<b>. [half.] b + [move.] b\nw<b>. [turn.^0..2] b + z 2 + ball\n<$>. w 2", 25, 4)]
    public void Object_HasItsInstances(string text, int boxes, int balls)
    {
        var fractal = Read(Head + text);
        Assert.Equal(boxes + balls, fractal.InstanceCount);
        foreach (var part in fractal.ByMesh.Where(static part => part.BaseMesh.FaceCount > 0))
        {
            Assert.True(BaseShapes.TryFind("box", out var box));
            Assert.Equal(ReferenceEquals(part.BaseMesh, box) ? boxes : balls, part.InstanceCount);
        }
    }

    [Fact]
    public void Recursive_OfOneCallWithoutAnythingElse_IsOneRepetition()
    {
        var linear = FractalParser.Parse(new("a.fdo", Head + "z<box>. [half., move.] (box)\n<$>. [turn.] z 9")).Description;
        Assert.Empty(linear.Parts);
        Assert.IsType<Repetition>(linear.Steps[1]);
    }

    [Theory]
    [InlineData("<$>. box + boll", "4:12: error: the object 'boll' is not declared above: did you mean 'ball'?")]
    [InlineData("<$>. [half.] box ball", "4:18: error: unexpected 'ball': objects have a plus sign between them, as in '+ ball'")]
    [InlineData("r. box + [half.] r", "4:18: error: 'r' is declared by itself: what repeats itself is a recursive, as in 'r<box>")]
    [InlineData("z<box>, w<ball>. [half.] box + w, ball", "4:32: error: within its own declaration, the recursive 'w' is called by the")]
    [InlineData("<$>. sphere", "4:6: error: the object 'sphere' is not declared above: did you mean 'ball'?")]
    [InlineData("up = (0, 1, 0)\n<$>. [up.] box", "5:7: error: 'up' is a vector, and a set has calls of transformations")]
    [InlineData("<$>. (box + ball", "4:17: error: unexpected end of file, expected ')'")]
    [InlineData("<$>. box + ", "4:12: error: unexpected end of file, expected")]
    [InlineData("z<box>, w<ball>. box + ball\n<$>. z 2", "4:1: error: 2 recursives have 2 bodies, with commas between them: found 1")]
    [InlineData("z<box>. box, ball\n<$>. z 2", "4:1: error: 1 recursive has 1 body: found 2")]
    [InlineData("z<box>, w<box>. box, box\n<$>. z 2", "4:11: error: the base 'box' is that of another recursive already: bases have")]
    [InlineData("z<box>. ball + ball\n<$>. z 2", "4:9: error: the body of the recursive 'z' is not built on its base 'box'")]
    [InlineData("z<box>, w<ball>. cone, plate\n<$>. z 2", "4:18: error: no recursive has a base in its body: its name there is")]
    [InlineData("z<box>. ball\n<$>. z 2", "4:9: error: the body of the recursive 'z' is not built on its base 'box'")]
    [InlineData("z<box>. box\n<$>. z 2", "4:9: error: the recursive 'z' adds no transformations to its base 'box'")]
    [InlineData(
        "z<box>. [half.] box\nw<box>. box + z\n<$>. w 2",
        "5:9: error: the body of the recursive 'w' is infinite: give the recursive in")]
    [InlineData("z<box>. [half.] box + box 2\n<$>. z 2", "4:27: error: 'box' is here the recursive with one level less, so it has no")]
    [InlineData("z<box>. [half.] box + ball\nw<z>. [half.] z\n<$>. w 2", "5:3: error: the base 'z' is infinite: give it a depth")]
    [InlineData("z<box>. [half.] box + ball\n<$>. z (-1)", "5:8: error: a depth is a whole number that is not negative, not -1")]
    [InlineData("z<box>. [half.] box + ball\n<$>. z 1000001", "5:8: error: the depth is more than the limit of 1000000")]
    [InlineData(
        "z<box>. [half.] box + [half.^1..30] box\n<$>. z 1000000",
        "5:1: error: the fractal has more than the limit of 5000000 calls of recursives at all levels")]
    [InlineData("composition componentwise\n<$>. box + ball", "5:1: error: sums, and recursives of several calls, can't be composed compo")]
    [InlineData(
        "z<box>. [move.] box + ball\n<$>. z",
        "5:1: error: the bounds of the infinite fractal don't converge: its transformations must shrink")]
    [InlineData("<$>. \"a.fdo\"", "4:6: error: a fractal can't contain itself: a.fdo → a.fdo")]
    [InlineData("<$>. box + \"b.fdo\"", "4:12: error: the file \"b.fdo\" is not found")]
    public void Mistake_IsNamedWhereItStands(string text, string message)
    {
        File.WriteAllText(_folder["a.fdo"], Head + text);
        var error = Assert.Throws<SourceException>(() => FractalFile.Read(_folder["a.fdo"])).Message;
        Assert.StartsWith($"{_folder["a.fdo"]}:{message}", error, StringComparison.Ordinal);
    }

    [Theory]
    [InlineData(
        "b.fdo", "<$>. \"c.fdo\"", "c.fdo", "<$>. box + \"a.fdo\"",
        "c.fdo:1:12: error: a fractal can't contain itself: a.fdo → b.fdo → c.fdo → a.fdo")]
    [InlineData(
        "b.fdo", "composition componentwise\n<$>. box", "c.fdo", "",
        "a.fdo:1:12: error: 'b.fdo' is composed componentwise, and can't")]
    [InlineData("b.fdo", "t. ((1, 0, 0), #, (0.5))\nz<box>. [t., #] box\n<$>. z", "c.fdo", "", "")]
    [InlineData("b.fdo", "<$>. bax", "c.fdo", "", "b.fdo:1:6: error: the object 'bax' is not declared above: did you mean 'box'?")]
    public void FractalFile_AsATerm_IsRead(string name1, string text1, string name2, string text2, string message)
    {
        File.WriteAllText(_folder[name1], text1);
        File.WriteAllText(_folder[name2], text2);
        if (message.Length == 0)
        {
            Assert.Null(Read("<$>. ball + \"b.fdo\"").InstanceCount);
            return;
        }

        var error = Assert.Throws<SourceException>(() => Read("<$>. box + \"b.fdo\"")).Message;
        Assert.Contains(message, error, StringComparison.Ordinal);
    }

    /// <summary>A sum has no levels, and is no mesh either.</summary>
    [Theory]
    [InlineData("<$>. box + cone")]
    [InlineData("t. ((1, 0, 0), #, #)\n<$>. [t.] box")]
    public void FractalFile_WithinComponentwiseComposition_IsRefusedWhereItStands(string inner)
    {
        File.WriteAllText(_folder["b.fdo"], inner);
        var error = Assert.Throws<SourceException>(() => Read("t. ((1, 0, 0), #, #)\ncomposition componentwise\n<$>. [t.] \"b.fdo\""));
        Assert.Contains(
            "a.fdo:3:11: error: a fractal that is composed componentwise can't have another fractal", error.Message,
            StringComparison.Ordinal);
    }

    [Fact]
    public void FractalFile_ThatIsInfinite_CanBeASetButNotARound()
    {
        File.WriteAllText(_folder["b.fdo"], "t. ((1, 0, 0), #, (0.5))\nz<box>. [t., #] box\n<$>. z");
        Assert.True(Read(Head + "<$>. [move.^0..3] [turn.] \"b.fdo\" + ball").Description.IsInfinite);
        Assert.Contains(
            "4:4: error: 'b.fdo' is infinite, and can't be repeated: give its recursive a depth",
            Assert.Throws<SourceException>(() => Read(Head + "b. \"b.fdo\"\nz<b>. [half.] b\n<$>. z 3")).Message, StringComparison.Ordinal);
    }

    [Fact]
    public void FractalFile_AsTheOnlyTerm_IsThatFractal()
    {
        var inner = Read("t. ((1, 0, 0), #, (0.5))\nz<box>. [t., #] box\n<$>. z 5", "b.fdo");
        Assert.Equal(inner, Read("<$>. \"b.fdo\""));
        var moved = Read(Head + "<$>. [move.] \"b.fdo\"", "c.fdo");
        Assert.Equal(inner.Apply([new(new(3, 0, 0), Vector.Zero, Vector.One)]), moved);
    }

    [Fact]
    public void Mesh_OfSeveralFiles_IsOne()
    {
        Read("<$>. box + ball", "b.fdo");
        Read("<$>. ball + \"b.fdo\"", "c.fdo");
        Assert.Equal(2, Read("<$>. box + \"b.fdo\" + [#] \"c.fdo\"").BaseMeshes.Length);
    }

    [Fact]
    public void Fractals_OfCode_AreThoseOfTheLanguage()
    {
        Assert.True(BaseShapes.TryFind("box", out var box) & BaseShapes.TryFind("ball", out var ball));
        Transformation grow = new(new(0, 1, 0), new(0, 60, 9), 0.7 * Vector.One);
        Transformation fork = new(new(0, 0.7, 0), new(0, 0, 40), 0.6 * Vector.One);
        var turns = Enumerable.Range(0, 3).Select(static turn => new Transformation(Vector.Zero, new(0, 120 * turn, 0), Vector.One));
        var made = Fractal.Recurse(
            Fractal.Of(ball!), 4, self => self.Apply([grow]) + self.Apply([fork]).Apply(turns) + Fractal.Of(box!));
        var read = Read(Tree);
        Assert.Equal(read.InstanceCount, made.InstanceCount);
        Assert.Equal(
            read.ByMesh.Select(static part => part.InstanceCount).Order(), made.ByMesh.Select(static part => part.InstanceCount).Order());
        Near.Equal(read.Bounds.Minimum, made.Bounds.Minimum, 1e-12);
        Near.Equal(read.Bounds.Maximum, made.Bounds.Maximum, 1e-12);
        Assert.Equal(341 + 1, (Fractal.Of(box!) + made.WithDepth(4)).ByMesh.Max(static part => part.InstanceCount) + 86);
    }

    [Fact]
    public void Fractals_ThatCantBePutTogether_AreRefused()
    {
        Assert.True(BaseShapes.TryFind("box", out var box));
        var half = new Transformation(Vector.Zero, Vector.Zero, 0.5 * Vector.One);
        var infinite = Fractal.Of(box!).Repeat([half]);
        Assert.Throws<ArgumentException>(() => Fractal.Sum());
        Assert.Throws<ArgumentException>(() => Fractal.Of(box!).WithComposition(Composition.Componentwise) + Fractal.Of(box!));
        Assert.Throws<ArgumentException>(() => Fractal.Recurse(Fractal.Of(box!), 3, self => self + infinite));
        Assert.Throws<ArgumentException>(() => Fractal.Recurse(infinite, 3, static self => self));
        Assert.Throws<ArgumentException>(() => Fractal.Recurse(Fractal.Of(box!), 3, self => self.Repeat([half])));
        Assert.Throws<ArgumentOutOfRangeException>(() => Fractal.Recurse(Fractal.Of(box!), -1, static self => self));
        Assert.True((infinite + Fractal.Of(box!)).Description.IsInfinite);
        Assert.Throws<ArgumentException>(() => new Fractal((infinite + Fractal.Of(Samples.Tetrahedron)).Description, box!));
    }

    [Theory]
    [InlineData(Tree)]
    [InlineData(Head + "<$>. [half.] (box + [turn.^0..9] ball)")]
    [InlineData(
        Head + "b. box\nc. ball\nz<b>, w<c>. [half.] [turn.^0..3] c + cone, [half.] b + [half.] [move.] c\n"
            + "<$>. [turn.] (z 5 + [half.] w 3 + w)")]
    [InlineData(Head + "z<box>. [half.] box + ball\nw<box>. [turn.^0..1] [half.] box + z 3 + plate\n<$>. [half.] w 2")]
    public void Written_IsReadAgain(string text)
    {
        var fractal = Read(text);
        FractalFile.Write(_folder["w.fdo"], fractal);
        var read = FractalFile.Read(_folder["w.fdo"]);
        Assert.Equal(fractal.Description, read.Description);
        Assert.Equal(fractal, read);
        FractalFile.Write(_folder["w.fdo"], read);
        Assert.Equal(fractal, FractalFile.Read(_folder["w.fdo"]));
    }

    /// <summary>The text of what sets of sets make is as long as that of the sets, and needs no parentheses inside each other.</summary>
    [Theory]
    [InlineData(9, 40)]
    [InlineData(2, 60)]
    [InlineData(1, 100)]
    public void Written_SetsOfSets_AreAsShortAsTheirText(int width, int count)
    {
        var sets = string.Concat(Enumerable.Range(0, count).Select(i =>
            $"[{string.Join(", ", Enumerable.Range(0, width).Select(j => $"t.({i}, {j}, 0)"))}] "));
        var fractal = Read($"t.p. (p, #, (0.5))\nz<box>. {sets}box + ball + [t.(1)] ({sets}box + [t.(2)] box)\n<$>. z 1");
        FractalFile.Write(_folder["w.fdo"], fractal);
        Assert.Equal(fractal, FractalFile.Read(_folder["w.fdo"]));
        Assert.InRange(new FileInfo(_folder["w.fdo"]).Length, 1, 300 * width * count);
    }

    [Fact]
    public void Written_RepetitionsOfCalls_AreReadAgain()
    {
        Transformation[] maps = [Samples.Move(1, 0, 0), Transformation.At(new(0, 1, 0), 0.5)];
        var cube = Fractal.Of(Shapes.Cube());
        var fractal = Fractal.Recurse(cube, 2, self => self.Repeat(maps, 40) + cube.Apply(maps) + self.Apply(maps).Apply(maps));
        FractalFile.Write(_folder["w.fdo"], fractal);
        Assert.Equal(fractal.Description, FractalFile.Read(_folder["w.fdo"]).Description);
        var deep = Fractal.Recurse(cube, 1, self => self.Repeat([Samples.Move(1, 0, 0)], 3000) + cube);
        var error = Assert.Throws<FractalEngineException>(() => FractalFile.Write(_folder["deep.fdo"], deep));
        Assert.Contains("more than the limit of 1000 sets on each other", error.Message, StringComparison.Ordinal);
    }

    /// <summary>What is made in code, in whatever order, is what its file says.</summary>
    [Fact]
    public void Written_FractalsMadeInCode_AreReadAgain()
    {
        BaseShapes.TryFind("box", out var boxMesh);
        BaseShapes.TryFind("cone", out var coneMesh);
        var (box, cone) = (Fractal.Of(boxMesh!), Fractal.Of(coneMesh!));
        Transformation[] u = [Samples.Move(1, 0, 0)];
        Transformation[] v = [Transformation.At(new(0, 1, 0), 0.5)];
        Fractal[] fractals =
        [
            Fractal.Recurse(box, 2, self => self.Apply(u)), Fractal.Recurse(box, 2, self => self.Apply(u).Apply(v)),
            Fractal.Recurse(box, 2, self => self.Repeat(u, 2)), Fractal.Recurse(box, 0, self => self.Apply(u)),
            Fractal.Recurse(box, null, static self => self.Apply([Transformation.At(new(0, 1, 0), 0.5)])) + cone,
            Fractal.Recurse(box, 2, static self => self.Apply([])), Fractal.Recurse(box, 3, static self => self),
            Fractal.Recurse(box, 3, static self => self.Apply([Transformation.Identity])),
            box.Repeat(u, 0) + Fractal.Recurse(box, 2, self => self.Apply(u) + self.Apply(v)),
            box.Repeat([.. u, .. v], 2) + Fractal.Recurse(box, 2, self => self.Apply(u) + cone),
            box.Apply([]) + cone, box.Apply([]) + cone.Apply(u), (box + cone).Apply(u) + (cone + box),
        ];
        foreach (var fractal in fractals)
        {
            FractalFile.Write(_folder["w.fdo"], fractal);
            Assert.Equal(fractal, FractalFile.Read(_folder["w.fdo"]));
        }
    }

    /// <summary>The longest chain of any of several recursives, with what it calls.</summary>
    [Theory]
    [InlineData("z<x>, w<y>. [half.] x, [half.] [half.] [half.] y + box\n<$>. z 3", 3)]
    [InlineData("z<x>, w<y>. [half.] y, [half.] [half.] [half.] x\n<$>. z 3", 5)]
    [InlineData("z<x>, w<y>. [half.] y, [half.] [half.] [half.] x\n<$>. w 4", 8)]
    [InlineData("z<x>. [half.] x + [half.] [half.] plate\n<$>. z 3", 5)]
    [InlineData("<$>. [half.] x + y + [half.] (x + [half.] y)", 2)]
    [InlineData("z<x>. [half.] x + plate\n<$>. [half.] z 3", 4)]
    [InlineData("z<x>. [] [half.] (x + x)\n<$>. z 1", 0)]
    public void Levels_AreThoseOfTheLongestChain(string text, long expected) =>
        Assert.Equal(expected, Read($"{Head}x. box\ny. ball\n{text}").LevelCount);

    [Fact]
    public void Recursives_WithoutACallOrOfNothing_AreRefused()
    {
        var cube = Fractal.Of(Shapes.Cube());
        Assert.Throws<ArgumentException>("body", () => Fractal.Recurse(cube, 1, _ => cube + cube.Apply([Samples.Move(1, 0, 0)])));
        Assert.Null(cube.Follow([0], firstStep: 1));
        var values = ImmutableDictionary<string, double>.Empty.Add("a", double.NaN);
        Assert.Throws<ArgumentException>("values", () => FractalParser.Parse(new("a.fdo", "a = 1\n<$>. box"), values));
    }

    /// <summary>What is made of many parts is refused by its size, however the text says it.</summary>
    [Theory]
    [InlineData("maps", 1000, "t. ((1, 0, 0), #, #)\n<$>. [t.^0..400 * t.^0..400", "*t.", "] box")]
    [InlineData("repeated-steps", 2000, "y. box\n<$>. box", " + [(#, #, (0.5))^0..1] y", "")]
    public void Work_ThatIsTooMuch_IsRefused(string limit, int count, string start, string piece, string end)
    {
        var text = start + string.Concat(Enumerable.Repeat(piece, count)) + end + "\n";
        if (limit == "repeated-steps")
        {
            var steps = string.Concat(Enumerable.Repeat("[t.] ", 900));
            text = $"t. (#, #, (0.9))\n{text.Replace("y. box", $"y. {steps}box", StringComparison.Ordinal)}";
        }

        var error = Assert.Throws<SourceException>(() => FractalParser.Parse(new("a.fdo", text)));
        Assert.True(error.Diagnostic.IsLimitExceeded);
    }

    [Fact]
    public void Terms_ThatDifferAtTheirEnds_AreToldApartSoon()
    {
        var text = string.Join(" + ", Enumerable.Range(0, 3000).Select(static i =>
            $"[#, #, #, #, t.({i})] box + [#] [#] [#] [#] [#] [t.({i})] box"));
        Assert.Equal(3000 * 6, Read($"t.a. ((a), #, #)\n<$>. {text}").InstanceCount);
    }

    [Fact]
    public void Path_OfAHit_LeadsToItsInstance()
    {
        Assert.All([Read(Tree), Read(Tree.Replace("z 4", "[turn.] (z 2 + [s.] z 3)", StringComparison.Ordinal))], static fractal =>
        {
            var caster = RayCaster.For(fractal);
            var collider = Collider.For(fractal);
            var context = new QueryContext();
            Seeded.Run(200, random =>
            {
                var (from, to) = (4 * random.Vector(), random.Vector() + (1.5 * Vector.J));
                if (caster.TryFindNearest(new(from, to - from), out var hit))
                {
                    Check(fractal, hit.InstancePath.AsSpan(), hit.InstanceMap, hit.MeshIndex);
                }

                Assert.True(collider.TryFindClosest(from, double.PositiveInfinity, context, out var closest));
                Assert.InRange(context.MeshIndex, 0, 1);
                var steps = fractal.Follow(context.InstancePath)!;
                var (a, b, c) = fractal.BaseMeshes[context.MeshIndex].Face(closest.FaceIndex);
                var (x, y, z) = closest.Barycentrics;
                Near.Equal(closest.Point, MapOf(steps) * ((x * a) + (y * b) + (z * c)), 1e-12);
            });
        });

        static void Check(Fractal fractal, ReadOnlySpan<int> path, AffineMap expected, int mesh)
        {
            var steps = fractal.Follow(path)!;
            Assert.True(steps.Count == 0 || steps[^1].IsInstance);
            Near.Equal(expected.Translation, MapOf(steps).Translation, 1e-12);
            Assert.Equal(fractal.BaseMeshes[mesh].UsedBounds, steps[^1].Box);
        }

        static AffineMap MapOf(IReadOnlyList<PathStep> steps) =>
            steps.Aggregate(AffineMap.Identity, static (map, step) => map * step.Map);
    }

    [Fact]
    public void Fractals_InThePlacesOfBaseMeshes_AreWhatAFileOfFilesIs()
    {
        File.WriteAllText(_folder["tree.fdo"], Tree);
        File.WriteAllText(_folder["row.fdo"], Head + "<$>. [move.^0..3] box");
        const string Text = Head + "x. \"row.fdo\"\n<$>. [turn.] \"tree.fdo\" + [half.] x + [move.] x + box";
        var file = Read(Text);
        var parsed = FractalParser.Parse(new("a.fdo", Text));
        Assert.True(BaseShapes.TryFind("box", out var box));
        Dictionary<string, Fractal> bases = new()
        {
            ["row.fdo"] = FractalFile.Read(_folder["row.fdo"]),
            ["tree.fdo"] = FractalFile.Read(_folder["tree.fdo"]),
            ["box"] = Fractal.Of(box),
        };
        Assert.Equal(file, Fractal.Of(parsed.Description, [.. parsed.Bases.Select(one => bases[one.File])]));
    }

    [Theory]
    [InlineData(Tree)]
    [InlineData(Head + "z<box>. [#, turn.] [half.] box\n<$>. z 3")]
    [InlineData(Head + "z<box>. [half.] box\nw<box>. [turn.^0..1] [half.] box + z 3 + plate\n<$>. [half.] w 2")]
    public void Boxes_BelowSoManyMaps_AreThoseOfAllPaths(string text)
    {
        var fractal = Read(text);
        var paths = new List<int[]> { Array.Empty<int>() };
        for (var depth = 0; depth < 5; depth++)
        {
            var expected = paths.ConvertAll(path => fractal.Follow(path)!).ConvertAll(static steps =>
                steps.Aggregate(AffineMap.Identity, static (map, step) => map * step.Map));
            Assert.Equal(expected, fractal.BoxesAt(depth).Select(static part => part.Map));
            paths = [.. paths.SelectMany(path => Enumerable.Range(0, 8).Select(index => (int[])[.. path, index]))
                .Where(path => fractal.Follow(path) is not null)];
        }

        Assert.True(fractal.BoxesAt(2).Count() > 1);
    }

    [Fact]
    public void Number_ThatIsSet_ChangesAllParts()
    {
        File.WriteAllText(_folder["a.fdo"], Tree);
        var options = new LoadOptions { Values = ImmutableDictionary<string, double>.Empty.Add("lean", 0) };
        Assert.NotEqual(FractalFile.Read(_folder["a.fdo"]).Bounds, FractalFile.Read(_folder["a.fdo"], options).Bounds);
        var deeper = FractalFile.Read(_folder["a.fdo"], options with { Depth = 5 });
        Assert.Equal(1024, deeper.ByMesh.Max(static part => part.InstanceCount));
    }

    [Fact]
    public void Count_OfAMeshThatIsNeverReached_IsZero()
    {
        var fractal = Read("t. ((1, 0, 0), #, (0.5))\na<box>, b<ball>. [t., #] box, [t., #] ball\n<$>. b");
        Assert.Equal([null, (BigInteger?)0], fractal.ByMesh.Select(static part => part.InstanceCount).Order());
        Assert.Contains(BigInteger.Zero, fractal.ByMesh.Select(static part => DistinctInstances.CountAtMost(part)));
    }

    [Fact]
    public void Instances_ThatShrinkToAPoint_AreCountedSoon()
    {
        var fractal = Read("t. ((1, 0, 0), #, (0.5))\nb<box>. [#, t.] box\n<$>. b 1000");
        Assert.Equal(1001, DistinctInstances.CountAtMost(fractal, budget: 0));
        Assert.Null(DistinctInstances.Count(fractal));
    }

    [Fact]
    public void Sets_OfManyMaps_MayHaveNothingOfAMesh()
    {
        var fractal = Read(Head + "<$>. [move.^1..65] box + ball");
        Assert.All(fractal.ByMesh, static part => Assert.False(part.Bounds.IsEmpty));
        Assert.Equal(66, fractal.InstanceCount);
        Assert.Equal(0, Read("<$>. [] box + [] ball").InstanceCount);
        Assert.Equal(BigInteger.One, DistinctInstances.CountAtMost(Read(Head + "z<box>. [half., #] box\n<$>. z + plate").ByMesh[1]));
    }

    [Fact]
    public void LongSets_InParentheses_TakeNoStack()
    {
        var set = string.Concat(Enumerable.Repeat("[half.]", 900));
        var text = Enumerable.Range(0, 30).Aggregate($"{set} box", (inner, _) => $"{set} ({inner} + {set} box)");
        Assert.Throws<SourceException>(() => Read($"{Head}z<box>. {text} + ball\n<$>. z 1"));
    }

    [Fact]
    public void Sums_OfSums_StaySmall()
    {
        var text = new StringBuilder("y0. box + ball\n");
        for (var i = 1; i < 200; i++)
        {
            text.Append(CultureInfo.InvariantCulture, $"y{i}. y{i - 1} + y{i - 1}\n");
        }

        var fractal = Read($"{text}<$>. y199");
        Assert.Equal(BigInteger.Pow(2, 200), fractal.InstanceCount);
        Assert.True(fractal.Description.Parts.Length < 210);
    }

    [Fact]
    public void FractalFile_ThatChanges_ChangesAllThatAreMadeOfIt()
    {
        File.WriteAllText(_folder["inner.fdo"], "<$>. box");
        File.WriteAllText(_folder["a.fdo"], "<$>. ball + \"inner.fdo\"");
        File.WriteAllText(_folder["b.fdo"], "<$>. cone + \"inner.fdo\"");
        File.WriteAllText(_folder["s.sdo"], "o \"a.fdo\" #\no \"b.fdo\" #\n");
        var cache = new AssetCache();
        BigInteger? Faces() => AssetLoader.Load(_folder["s.sdo"], null, cache: cache).Scene.Sum(static model => model.FaceCount);
        var before = Faces();
        Assert.Equal(before, Faces());
        File.WriteAllText(_folder["inner.fdo"], "move. ((2, 0, 0), #, #)\n<$>. [move.^0..4] box");
        Assert.Equal(before + (2 * 4 * 12), Faces());
    }

    [Fact]
    public void Mesh_WithoutFaces_ShowsNothing()
    {
        File.WriteAllText(_folder["empty.obj"], "v 100 0 0\nv 0 100 0\n");
        var fractal = Read(Head + "e. \"empty.obj\"\nz<e>. [half.] e + [move.] e + box\n<$>. z 4 + e");
        Assert.Equal(15, fractal.InstanceCount);
        Assert.False(fractal.HasSeveralMeshes);
        // Two of them are the same.
        Assert.Equal(14 * 12, fractal.Flatten(1000).FaceCount);
        Assert.Equal(0.5, fractal.Bounds.Maximum.Y, 1e-12);
        Assert.Equal(0.5, Collider.For(fractal).FindClosest(new(0, 1, 0)).Distance, 1e-12);
    }
}
