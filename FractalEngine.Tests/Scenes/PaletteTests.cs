using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;
using static System.FormattableString;

namespace FractalEngine.Tests.Scenes;

/// <summary>Colours of palettes by position, their means, and the lightness of the named ones.</summary>
public class PaletteTests
{
    [Fact]
    public void ColourAt_OfAnyStops_IsTheMixtureOfTheTwoAround()
    {
        Seeded.Run(200, random =>
        {
            var palette = Random(random);
            for (var i = 0; i < 20; i++)
            {
                var position = random.Next(4) == 0
                    ? palette.Stops[random.Next(palette.Stops.Length)].Position : random.Between(-0.2, 1.2);
                Near.Equal(Mixed(palette, position), palette.ColourAt(position), 1e-12);
            }
        });
    }

    [Fact]
    public void MeanOver_OfAnyRange_IsTheMeanOfManyColours()
    {
        const int count = 20000;
        Seeded.Run(20, random =>
        {
            var palette = Random(random);
            var (from, to) = (random.Between(-0.1, 1), random.Between(-0.1, 1));
            (from, to) = (Math.Min(from, to), Math.Max(from, to));
            var sum = Vector.Zero;
            for (var i = 0; i < count; i++)
            {
                sum += Mixed(palette, from + ((i + 0.5) / count * (to - from)));
            }

            // A sharp edge falls between two samples.
            Near.Equal(sum / count, palette.MeanOver(from, to), 2.0 * palette.Stops.Length / count);
            Near.Equal(palette.ColourAt(from), palette.MeanOver(from, from), 1e-12);
            Near.Equal(palette.MeanOver(from, to), palette.MeanOver(from, to + 1e-12), 1e-3);
        });
    }

    [Fact]
    public void NamedPalettes_GrowLighterByEvenSteps()
    {
        Assert.Equal(12, NamedPalettes.All.Select(static palette => palette.Name).Distinct().Count());
        foreach (var palette in NamedPalettes.All)
        {
            var (dark, light) = (Lightness(palette.ColourAt(0)), Lightness(palette.ColourAt(1)));
            Assert.True(dark < 0.31 && light > 0.85, palette.Name);
            for (var i = 0; i <= 1000; i++)
            {
                var even = dark + (i / 1000.0 * (light - dark));
                var found = Lightness(palette.ColourAt(i / 1000.0));
                Assert.True(Math.Abs(found - even) < 0.002, Invariant($"{palette.Name} at {i}: {found}, expected {even}"));
            }

            Assert.Same(palette, NamedPalettes.Find(palette.Name!));
            Assert.Equal(palette.Stops.Length, palette.Stops.Distinct().Count());
        }

        Assert.Null(NamedPalettes.Find("Ember"));
    }

    [Fact]
    public void Palettes_OfOtherStopsOrNames_AreNotEqual()
    {
        var palette = Palette.OfEven(Colour.Black, Colour.White);
        Assert.Equal(palette, Palette.OfEven(Colour.Black, Colour.White));
        Assert.Equal(palette.GetHashCode(), Palette.OfEven(Colour.Black, Colour.White).GetHashCode());
        Assert.True(palette.IsEven);
        Palette[] others =
        [
            Palette.OfEven(Colour.Black, Colour.Black), Palette.OfEven(Colour.Black, Colour.White, Colour.White),
            new([new(0, Colour.Black), new(0.5, Colour.White)]), new([.. NamedPalettes.All[3].Stops]),
        ];
        Assert.All(others, other => Assert.NotEqual(palette, other));
        Assert.NotEqual(NamedPalettes.All[3], others[3]);
        Assert.Equal(
            Gradient.Of(GradientKind.Trap, palette), Gradient.Of(GradientKind.Trap, Palette.OfEven(Colour.Black, Colour.White)));
        Assert.NotEqual(Gradient.Of(GradientKind.Trap, palette), new Gradient(GradientKind.Trap, Colour.White));
    }

    [Fact]
    public void Palette_OfTooFewStopsOrOthers_IsRefused()
    {
        Assert.Throws<ArgumentException>(static () => Palette.OfEven(Colour.Black));
        Assert.Throws<ArgumentException>(static () => new Palette([new(-0.1, Colour.Black), new(0.5, Colour.White)]));
        Assert.Throws<ArgumentException>(static () => new Palette([new(0.6, Colour.Black), new(0.5, Colour.White)]));
        Assert.Throws<ArgumentException>(static () => new Palette([new(0.6, Colour.Black), new(double.NaN, Colour.White)]));
        Assert.Throws<ArgumentException>(static () => new Palette([new(0.6, Colour.Black), new(1.1, Colour.White)]));
    }

    /// <summary>Stops anywhere: sharp edges, ends that are missing.</summary>
    internal static Palette Random(Random random)
    {
        var positions = Enumerable.Range(0, random.Next(2, 7)).Select(
            _ => random.Next(3) == 0 ? random.Next(5) / 4.0 : random.NextDouble());
        return new([.. positions.Order().Select(position => new PaletteStop(position,
            new(random.NextDouble(), random.NextDouble(), random.NextDouble())))]);
    }

    private static Vector Mixed(Palette palette, double position)
    {
        if (position < palette.Stops[0].Position)
        {
            return palette.Stops[0].Colour.ToLinearVector();
        }

        // Behind a sharp edge the last colour counts.
        var before = palette.Stops.Last(stop => stop.Position <= position);
        if (palette.Stops.All(stop => stop.Position <= position))
        {
            return palette.Stops[^1].Colour.ToLinearVector();
        }

        var after = palette.Stops.First(stop => stop.Position > position);
        var part = (position - before.Position) / (after.Position - before.Position);
        return before.Colour.ToLinearVector() + (part * (after.Colour.ToLinearVector() - before.Colour.ToLinearVector()));
    }

    /// <summary>Lightness of Oklab, by the matrices of its paper from linear light.</summary>
    private static double Lightness(Vector linear)
    {
        var l = Math.Cbrt((0.4122214708 * linear.X) + (0.5363325363 * linear.Y) + (0.0514459929 * linear.Z));
        var m = Math.Cbrt((0.2119034982 * linear.X) + (0.6806995451 * linear.Y) + (0.1073969566 * linear.Z));
        var s = Math.Cbrt((0.0883024619 * linear.X) + (0.2817188376 * linear.Y) + (0.6299787005 * linear.Z));
        return (0.2104542553 * l) + (0.7936177850 * m) - (0.0040720468 * s);
    }
}
