using System.Runtime.CompilerServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render;
using FractalEngine.Render.Preparation;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;
using FractalEngine.Tests.Render;
using Xunit.Abstractions;

namespace FractalEngine.Tests.Stability;

/// <summary>Draws surfaces that are close behind each other, from the near plane to the far one.</summary>
[Collection(GlTests.Name)]
public sealed class DepthBufferStabilityTests(ITestOutputHelper output)
{
    private const int Size = 40;
    private const double Near = 1;

    // Both are fractions of the distance.
    private const double Gap = 1e-4;
    private const double Millionth = 1e-6;

    // Without culling, only the depth buffer decides what hides what.
    private static readonly RenderSettings Settings = new() { Samples = 0, Culling = null };

    /// <summary>Distance of the far plane divided by that of the near plane.</summary>
    public static TheoryData<double> Ranges => [1e2, 1e4, 1e7];

    /// <summary>
    /// The red surface is closer, so each pixel is red. Rotated by 40°, the two are still the same fraction of the distance apart along
    /// every line of sight.
    /// </summary>
    [SkippableTheory]
    [MemberData(nameof(Ranges))]
    public void Surfaces_ATenThousandthApart_KeepTheirOrder(double range)
    {
        using var report = new StabilityReport(output, range);
        using var stage = new Stage();
        foreach (var distance in Distances(range))
        {
            // Rotated, they reach from two thirds of their distance to twice as far, where neither plane may cut them.
            foreach (var degrees in distance < 2 * Near || distance > 0.5 * range ? (double[])[0] : [0, 40])
            {
                report.Require(
                    "pixels that show what is 1e-4 of the distance behind", stage.CountWrong(distance, range, degrees, Gap), 0,
                    () => $"at {distance} of {range}, turned by {degrees}");
            }
        }
    }

    /// <summary>
    /// Finds how close surfaces can be. At some gap one of both orders of drawing shows the wrong surface, or the test would prove nothing.
    /// </summary>
    [SkippableFact]
    public void Surfaces_CloserTogether_KeepTheirOrderDownToAMillionth() => CheckSmallestGap(1e7);

    [SkippableTheory]
    [InlineData(1e2)]
    [InlineData(1e4)]
    [Trait("Category", "Soak")]
    public void Surfaces_CloserTogetherInOtherRanges_KeepTheirOrderDownToAMillionth(double range) => CheckSmallestGap(range);

    private void CheckSmallestGap(double range, [CallerMemberName] string test = "")
    {
        using var report = new StabilityReport(output, range, test);
        using var stage = new Stage();
        var maxFailingGap = 0.0;
        foreach (var distance in Distances(range))
        {
            // The roundings of one distance alone may be lucky.
            var around = Enumerable.Range(0, 5).Select(i => distance * (1 - (0.0013 * i))).ToArray();
            var minGap = double.PositiveInfinity;
            var gap = Millionth;
            while (gap > 1e-12 && around.All(near => stage.CountWrong(near, range, 0, gap) == 0))
            {
                minGap = gap;
                gap /= 2;
            }

            maxFailingGap = Math.Max(maxFailingGap, gap);
            // A float has 24 bits: two depths that are 1e-7 of themselves apart are next to each other. The limit is ten of these, for the
            // roundings of the matrices.
            report.Require(
                "smallest gap that keeps its order by distance (of the distance)", minGap, Millionth, () => $"at {distance} of {range}",
                distance);
        }

        Assert.InRange(maxFailingGap, 1e-9, Millionth);
    }

    private static IEnumerable<double> Distances(double range) =>
        Enumerable.Range(0, 30).Select(i => Near * Math.Pow(10, i / 3.0)).Where(distance => distance < 0.7 * range)
        .Select(distance => Math.Max(distance, 1.01 * Near)).Append(0.999 * range);

    /// <summary>Draws two squares that fill the frame, in full light.</summary>
    private sealed class Stage : IDisposable
    {
        private readonly SharedContext _context = new();
        private readonly FrameRenderer _frame;

        public Stage()
        {
            if (!((OffscreenContext)_context).HasReversedDepth)
            {
                _context.Dispose();
                throw new SkipException("depth can't be reversed here: glClipControl needs OpenGL 4.5 or GL_ARB_clip_control");
            }

            _frame = new(_context);
        }

        /// <summary>Counts the pixels that show the surface behind, whichever is drawn first.</summary>
        public int CountWrong(double distance, double range, double degrees, double gap)
        {
            var (red, green) = (new Colour(1, 0, 0), new Colour(0, 1, 0));
            var behind = Square(distance * (1 + gap), degrees, green);
            // Objects are drawn by the depth of their farthest point: with a tail, what is in front comes last.
            return CountNotRed(range, Square(distance, degrees, red), behind)
                + CountNotRed(range, Square(distance, degrees, red, hasTail: true), behind);
        }

        public void Dispose()
        {
            _frame.Dispose();
            _context.Dispose();
        }

        private int CountNotRed(double range, params ReadOnlySpan<(Model Model, Transformation Placement, Colour? Colour)> squares)
        {
            var scene = RenderScenes.Scene(new Scene { Background = Colour.Black, Lights = [RenderScenes.FullLight] }, squares);
            using var renderer = new SceneRenderer(_context, DrawableScene.Prepare(scene, Settings));
            var view = new View(new(Vector.Zero, Vector.Zero, 60), Projection.Perspective) { FixedClipPlanes = (Near, range * Near) };
            _frame.Draw(renderer, view, Size, Size, Settings);
            _context.Resources.ThrowOnError("drawing");
            return RenderScenes.CountDifferent(_frame.Capture(), (255, 0, 0, 255));
        }

        private static (Model Model, Transformation Placement, Colour? Colour) Square(
            double distance, double degrees, Colour colour, bool hasTail = false)
        {
            var mesh = RenderScenes.Square(1);
            // A triangle far beside the frame.
            var tail = new Mesh(
                [.. mesh.Positions, 1, 1, 0, 1, 1, 0.001, 0.99, 1, 0.001],
                [.. mesh.VertexIndices, mesh.VertexCount, mesh.VertexCount + 1, mesh.VertexCount + 2]);
            var placement = new Transformation(new(0, 0, distance), new(degrees, 0, 0), 50 * distance * Vector.One);
            return (RenderScenes.Model(hasTail ? tail : mesh), placement, colour);
        }
    }
}
