using System.Collections.Immutable;
using FractalEngine.Core;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Fdo.Writing;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Fdo.Writing;

public class FractalWriterTests
{
    private static readonly Transformation Half = Samples.MoveAndScale(1, 2, 3, 0.5);

    private static string Write(params FractalStep[] steps) => FractalWriter.Write(new([.. steps]), "b.obj");

    private static TransformationSet Set(params Transformation[] transformations) => new([.. transformations]);

    private static void AssertReadsBack(FractalDescription description)
    {
        var parsed = Samples.ParseFractal(FractalWriter.Write(
            description, [.. Enumerable.Range(0, description.MeshCount).Select(static index => $"b{index}.obj")]));
        Assert.Equal("b0.obj", parsed.BaseFile);
        Assert.Equal(description.Composition, parsed.Description.Composition);
        Assert.Equal(description, parsed.Description);
        // Equality holds for 0 and −0; the bits tell them apart.
        Assert.Equal(BitsOf(description.Steps), BitsOf(parsed.Description.Steps));
    }

    private static string BitsOf(IEnumerable<FractalStep> steps) => string.Concat(steps.Select(step => step switch
    {
        TransformationSet set => $"[{Bits.Of(set.Transformations)}]",
        Repetition repetition => $"({BitsOf(repetition.Round)})^{repetition.Count}",
        _ => throw new ArgumentException("unknown kind of step"),
    }));

    [Fact]
    public void Write_OfRandomFractals_ReadsBackToTheSameBits() => Seeded.Run(1000, random => AssertReadsBack(RandomDescription(random)));

    [Theory]
    [MemberData(nameof(AssetFiles))]
    public void Write_OfAnAssetFractal_ReadsBackToTheSameBits(string file) =>
        AssertReadsBack(Samples.ParseFractal(File.ReadAllText(Repository.Full(file))).Description);

    public static TheoryData<string> AssetFiles =>
        [.. Directory.EnumerateFiles(Repository.Full("assets"), "*.fdo", SearchOption.AllDirectories)
            .Select(file => Path.GetRelativePath(Repository.Root, file).Replace('\\', '/')).Order(StringComparer.Ordinal)];

    [Fact]
    public void Write_OfASponge_IsWhatAPersonWrites()
    {
        double[] thirds = [-1.0 / 3, 0, 1.0 / 3];
        var cells =
            from x in thirds
            from y in thirds
            from z in thirds
            where new[] { x, y, z }.Count(component => component == 0) < 2
            select Transformation.At(new(x, y, z), 0.25);
        Assert.Equal("""
            # 1 to 20: positions.
            v -0.3333333333333333 -0.3333333333333333 -0.3333333333333333
            v -0.3333333333333333 -0.3333333333333333 0
            v -0.3333333333333333 -0.3333333333333333 0.3333333333333333
            v -0.3333333333333333 0 -0.3333333333333333
            v -0.3333333333333333 0 0.3333333333333333
            v -0.3333333333333333 0.3333333333333333 -0.3333333333333333
            v -0.3333333333333333 0.3333333333333333 0
            v -0.3333333333333333 0.3333333333333333 0.3333333333333333
            v 0 -0.3333333333333333 -0.3333333333333333
            v 0 -0.3333333333333333 0.3333333333333333
            v 0 0.3333333333333333 -0.3333333333333333
            v 0 0.3333333333333333 0.3333333333333333
            v 0.3333333333333333 -0.3333333333333333 -0.3333333333333333
            v 0.3333333333333333 -0.3333333333333333 0
            v 0.3333333333333333 -0.3333333333333333 0.3333333333333333
            v 0.3333333333333333 0 -0.3333333333333333
            v 0.3333333333333333 0 0.3333333333333333
            v 0.3333333333333333 0.3333333333333333 -0.3333333333333333
            v 0.3333333333333333 0.3333333333333333 0
            v 0.3333333333333333 0.3333333333333333 0.3333333333333333
            # 21: scale.
            v 0.25 0.25 0.25

            x. "b.obj"
            t.a. (a, #, 21)
            z<x>. [t.1, t.2, t.3, t.4, t.5, t.6, t.7, t.8, t.9, t.10, t.11, t.12, t.13, t.14, t.15, t.16, t.17, t.18, t.19, t.20] x
            <$>. z 5

            """, Write(new Repetition([Set([.. cells])], 5)));
    }

    [Fact]
    public void Write_OfAppendixB_IsShorterThanTheOriginalAndAsClear() => Assert.Equal("""
        # 1 to 8: positions.
        v 1 1 -2
        v 1 -1 -2
        v -1 1 -2
        v -1 -1 -2
        v 10 10 -10
        v 10 -10 -10
        v -10 10 -10
        v -10 -10 -10
        # 9 to 12: rotations in degrees.
        v 135 45 0
        v 135 -45 0
        v -135 45 0
        v -135 -45 0
        # 13 and 14: scales.
        v 0.5 0.5 0.5
        v 0.1 0.1 0.1

        x. "b.obj"
        t.a. (a, #, 13)
        u.a.b. (a, b, 14)
        z<x>. [#, u.5.9, u.6.10, u.7.11, u.8.12] [#, t.1, t.2, t.3, t.4] x
        <$>. z 6

        """, FractalWriter.Write(Samples.ParseFractal(Samples.AppendixB).Description, "b.obj"));

    [Fact]
    public void Write_OfNoSteps_IsTheBaseMesh() => Assert.Equal("x. \"b.obj\"\n<$>. x\n", Write());

    [Fact]
    public void Write_OfTheIdentity_NeedsNoVector() =>
        Assert.Equal("x. \"b.obj\"\n<$>. [#] [] [#, #] x\n", Write(Set(Transformation.Identity), Set(),
            Set(Transformation.Identity, Transformation.Identity)));

    [Fact]
    public void Write_OfNearlyTheIdentity_DoesNotBecomeIt()
    {
        // −0 has other bits than 0, though they are equal.
        var text = Write(Set(Transformation.Identity with { Rotation = new(0, -0.0, 0) }));
        Assert.Contains("v 0 -0 0\n", text, StringComparison.Ordinal);
        Assert.Contains("(#, a, #)", text, StringComparison.Ordinal);
    }

    [Fact]
    public void Write_OfEqualTransformations_CallsOneFunctionTwice() => Assert.EndsWith(
        "t. (1, #, 2)\n<$>. [t., t., #] x\n", Write(Set(Half, Half, Transformation.Identity)), StringComparison.Ordinal);

    [Fact]
    public void Write_OfRepetitionsAfterEachOther_NamesWhatIsInBetween() => Assert.EndsWith("""
        z<x>. [#] x
        y. [] z 2
        z2<y>. [#] [#] y
        y2. z2 0
        z3<y2>. [#] y2
        <$>. [#] z3 1000000

        """, Write(
            Set(Transformation.Identity), new Repetition([Set(Transformation.Identity)], 1_000_000),
            new Repetition([Set(Transformation.Identity), Set(Transformation.Identity)], 0), Set(),
            new Repetition([Set(Transformation.Identity)], 2)), StringComparison.Ordinal);

    [Fact]
    public void Write_OfNestedRepetitions_NestsRecursives() => Assert.Equal("""
        x. "b.obj"
        z<x>. [#] x
        z2<x>. [] z 3
        z3<x>. z2 4
        <$>. z3

        """, Write(new Repetition(
            [new Repetition([Set(), new Repetition([Set(Transformation.Identity)], 3)], 4)], null)));

    [Fact]
    public void Write_OfTheComponentwise_SaysSo() => Assert.StartsWith(
        "composition componentwise\n", FractalWriter.Write(new([Set(Half)], Composition.Componentwise), "b.obj"), StringComparison.Ordinal);

    [Theory]
    [InlineData("../some folder/büro #1.obj")]
    [InlineData(" .OBJ")]
    [InlineData("'\\<$>[.obj")]
    [InlineData("C:/b.obj")]
    public void Write_OfUnusualFileNames_ReadsBack(string file) =>
        Assert.Equal(file, Samples.ParseFractal(FractalWriter.Write(new([]), file)).BaseFile);

    [Theory]
    [InlineData("a\"b.obj")]
    [InlineData("a\nb.obj")]
    [InlineData("a\rb.obj")]
    [InlineData("a\0b.obj")]
    public void Write_OfAFileNameThatQuotesCannotHold_IsRefused(string file)
    {
        var error = Assert.Throws<FractalEngineException>(() => FractalWriter.Write(new([]), file));
        Assert.StartsWith("the name 'a", error.Message, StringComparison.Ordinal);
        Assert.EndsWith("' can't be written into a file: it has a quote, a line break or a faulty character", error.Message,
            StringComparison.Ordinal);
        Assert.DoesNotContain(error.Message, char.IsControl);
        Assert.Equal(ErrorKind.Input, error.Kind);
    }

    [Fact]
    public void Write_OfAFileNameThatUtf8CannotExpress_IsRefused() => Assert.Contains(
        "a faulty character", Assert.Throws<FractalEngineException>(() => FractalWriter.Write(new([]), "a\uD83Db.obj")).Message,
        StringComparison.Ordinal);

    [Fact]
    public void Write_OfABaseThatIsNoMesh_IsRefused() => Fails(
        ErrorKind.Input,
        "expected the name of a mesh (.obj, .obj.gz, .ply, .stl, .glb, .gltf) or fractal (.fdo): that is the base of a fractal",
        () => FractalWriter.Write(new([]), "a.sdo"));

    [Fact]
    public void Write_OfASingularScale_IsRefused() => Fails(
        ErrorKind.Input, "the scale (1, 0, 1) is singular: each factor must lie between 1e-100 and 1e100 in size",
        () => Write(Set(Half with { Scale = new(1, 0, 1) })));

    [Fact]
    public void Write_OfAnInfiniteRepetitionBelowAnother_IsRefused()
    {
        var infinite = new Repetition([Set(Half)], null);
        Fails(ErrorKind.Input, "an infinite repetition can't be repeated again", () => Write(infinite, infinite));
        Fails(ErrorKind.Input, "an infinite repetition can't be repeated again", () => Write(infinite.WithCount(3), Set(), infinite));
        AssertReadsBack(new([Set(Half), infinite, Set(), infinite.WithCount(3)]));
    }

    [Fact]
    public void Write_OfTheInfiniteComponentwise_IsRefused() => Fails(
        ErrorKind.Input, "an infinite fractal can't be composed componentwise: its positions don't shrink; give it a depth",
        () => FractalWriter.Write(new([new Repetition([Set(Half)], null)], Composition.Componentwise), "b.obj"));

    [Fact]
    public void Write_BeyondALimitOfTheLanguage_NamesIt()
    {
        Fails(ErrorKind.Limit, $"the depth is more than the limit of {FractalLimits.Depth.Value}",
            () => Write(new Repetition([Set()], (int)FractalLimits.Depth.Value + 1)));
        Fails(ErrorKind.Limit, $"the fractal has more than the limit of {FractalLimits.Levels.Value} levels",
            () => Write(new Repetition([Set(), Set(), Set()], (int)FractalLimits.Depth.Value)));
        var limits = $"{FractalLimits.Steps.Value} steps, or of {FractalLimits.Nesting.Value} recursives inside each other";
        Fails(ErrorKind.Limit, $"the object has more than the limit of {limits}",
            () => Write([.. Enumerable.Repeat(Set(), (int)FractalLimits.Steps.Value + 1)]));
        AssertReadsBack(new([.. Enumerable.Repeat(Set(), (int)FractalLimits.Steps.Value)]));
    }

    [Fact]
    public void Write_OfDeepNesting_IsRefusedBeyondTheLimitOnly()
    {
        FractalStep step = Set(Half);
        for (var nesting = 0; nesting < FractalLimits.Nesting.Value; nesting++)
        {
            step = new Repetition([step], 1);
        }

        AssertReadsBack(new([step]));
        Fails(ErrorKind.Limit, $"it has more than the limit of {FractalLimits.Nesting.Value} repetitions inside each other",
            () => Write(Set(Half), new Repetition([step], 1), Set(Half)));
    }

    [Fact]
    [Trait("Category", "Soak")]
    public void Write_OfAFewObjectsThatStandForMillions_NamesTheLimitOfTheText()
    {
        // Every object is used twice, so that the text would double with each level of nesting.
        FractalStep step = Set();
        for (var nesting = 0; nesting < FractalLimits.Nesting.Value; nesting++)
        {
            step = new Repetition([step, step], 0);
        }

        Fails(ErrorKind.Limit, $"its text has more than the limit of {ParsingLimits.DescriptionBytes.Value} bytes",
            () => Write(step));
        var large = Set([.. Enumerable.Repeat(Half, 100_000)]);
        Fails(ErrorKind.Limit, $"its text has more than the limit of {ParsingLimits.DescriptionBytes.Value} bytes",
            () => Write([.. Enumerable.Repeat(large, (int)FractalLimits.Steps.Value)]));
    }

    [Theory]
    [MemberData(nameof(InCulture.Names), MemberType = typeof(InCulture))]
    public void Write_InAnyCulture_IsTheSameText(string culture)
    {
        var description = new FractalDescription([new Repetition([Set(Half, Samples.Move(-1234.5, 1e-9, 1e20))], 12_345)]);
        Assert.Equal(FractalWriter.Write(description, "b.obj"), InCulture.Run(culture, () => FractalWriter.Write(description, "b.obj")));
    }

    [Fact]
    public void Write_OfManyMaps_TakesNoQuadraticTime()
    {
        var random = new Random(1);
        var set = Set([.. Enumerable.Range(0, 100_000).Select(_ => Transformation.At(random.Vector(), 0.5))]);
        // It takes a quarter of a second. The square of the maps would be ten thousand million.
        var text = ProcessorTime.RunWithin(5, () => Write(new Repetition([set], 2)));
        Assert.Equal(100_000, Samples.ParseFractal(text).Description.Steps[0].LevelAt(0).Transformations.Length);
    }

    private static void Fails(ErrorKind kind, string fault, Func<string> write)
    {
        var error = Assert.Throws<FractalEngineException>(() => { write(); });
        Assert.Equal($"the fractal can't be written as a file: {fault}", error.Message);
        Assert.Equal(kind, error.Kind);
    }

    private static FractalDescription RandomDescription(Random random)
    {
        var steps = RandomSteps(random, random.Next(0, 5), maxNesting: 3).ToBuilder();
        var composition = random.Next(4) == 0 ? Composition.Componentwise : Composition.Affine;
        if (composition == Composition.Affine && random.Next(3) == 0)
        {
            steps.Insert(0, new Repetition(RandomSteps(random, random.Next(1, 3), maxNesting: 2), null));
            steps.InsertRange(0, RandomSteps(random, random.Next(0, 3), maxNesting: 0));
        }

        return new(steps.ToImmutable(), composition);
    }

    private static ImmutableArray<FractalStep> RandomSteps(Random random, int count, int maxNesting) =>
    [
        .. Enumerable.Range(0, count).Select(_ => maxNesting == 0 || random.Next(2) == 0
            ? (FractalStep)RandomSet(random)
            : new Repetition(RandomSteps(random, random.Next(1, 4), maxNesting - 1), random.Next(0, 40))),
    ];

    private static TransformationSet RandomSet(Random random)
    {
        var common = RandomTransformation(random);
        var kind = random.Next(6);
        return Set([.. Enumerable.Range(0, random.Next(0, 6)).Select(_ => Vary(random, common, kind))]);
    }

    /// <summary>Sets in which all differ, and sets that agree in one or two of the three vectors, or in all.</summary>
    private static Transformation Vary(Random random, Transformation common, int kind)
    {
        var other = RandomTransformation(random);
        return random.Next(8) == 0 ? Transformation.Identity : kind switch
        {
            0 => common,
            1 => common with { Position = other.Position },
            2 => common with { Rotation = other.Rotation },
            3 => common with { Position = other.Position, Scale = other.Scale },
            _ => other,
        };
    }

    private static Transformation RandomTransformation(Random random) =>
        new(RandomVector(random, RandomNumber), RandomVector(random, RandomNumber), RandomVector(random, RandomFactor));

    private static Vector RandomVector(Random random, Func<Random, double> number) =>
        random.Next(3) == 0 ? number(random) * Vector.One : new(number(random), number(random), number(random));

    private static double RandomNumber(Random random) => random.Next(8) switch
    {
        0 or 1 => 0,
        2 => -0.0,
        3 => random.Next(-3, 4),
        4 => double.Epsilon * random.Next(1, 5),
        5 => double.MaxValue / random.Next(1, 5),
        _ => BitConverter.Int64BitsToDouble(random.NextInt64()) is var number && double.IsFinite(number) ? number : 1.0 / 3,
    };

    private static double RandomFactor(Random random) => random.Next(4) switch
    {
        0 or 1 => 1,
        2 => random.Next(2) == 0 ? 0.5 : -1,
        _ => Math.Pow(10, random.Between(-99, 99)) * (random.Next(2) == 0 ? 1 : -1),
    };
}
