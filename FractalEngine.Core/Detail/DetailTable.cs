using FractalEngine.Core.Collision;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Detail;

/// <summary>
/// The levels of a fractal as they are drawn: one state for each number of levels left, with the boxes that exact search has found, and without copies
/// that would be drawn twice. Kilobytes at any depth.
/// </summary>
public sealed class DetailTable
{
    // Of a box that holds another, beside which it is not counted that the other reaches out.
    private const double Within = 1.001;

    private readonly DetailState[] _states;
    private readonly StateRegion[] _regions;

    private DetailTable(DetailState[] states, StateRegion[] regions, long levels, Mesh mesh) =>
        (_states, _regions, Levels, Mesh, Base) = (states, regions, levels, mesh, new(mesh));

    /// <summary>What every instance is a copy of.</summary>
    public Mesh Mesh { get; }

    /// <summary>The same, for drawing it into a <see cref="CoverageBuffer"/>.</summary>
    internal BaseMesh Base { get; }

    /// <summary>The levels of the whole fractal; a huge number where they are infinitely many.</summary>
    internal long Levels { get; }

    /// <summary>The table of any fractal.</summary>
    /// <exception cref="FractalLimitException">
    /// Bounds overflow a double or don't settle, as those of an infinite fractal that grows; or there are more than
    /// <see cref="FractalLimits.ComponentwiseSums"/> sums in componentwise composition.
    /// </exception>
    /// <exception cref="SingularMatrixException">A map flattens what it maps.</exception>
    public static DetailTable Of(Fractal fractal) =>
        fractal.Description.Composition == Composition.Componentwise ? OfSums(fractal) : OfLevels(fractal);

    /// <summary>The table of a mesh that is drawn once.</summary>
    public static DetailTable Of(Mesh mesh) => new([new(mesh.FaceCount == 0 ? BoundingBox.Empty : mesh.Bounds, AffineMap.Identity, [])], [new(0, 1, 0, 1)], 0, mesh);

    /// <summary>The state with so many levels left.</summary>
    internal DetailState At(long levels) => _states[StateRegion.Find(_regions, levels)];

    private static DetailTable OfLevels(Fractal fractal)
    {
        var builder = new SubFractalBuilder(fractal);
        builder.AddAll();
        var regions = builder.Regions.ToArray();
        var states = new DetailState[builder.States.Count];
        foreach (var region in regions)
        {
            for (var i = 0; i < region.Period; i++)
            {
                states[region.State + i] = StateOf(builder, region.First + i);
            }
        }

        return new(states, regions, builder.Levels, fractal.BaseMesh);
    }

    private static DetailState StateOf(SubFractalBuilder builder, long level)
    {
        var children = builder.StepsAt(level)
            .Select(step => (Step: step, Below: builder.OutlineAt(step.LevelsLeft(level))))
            .Where(child => !child.Below.Box.IsEmpty)
            .Select(child => new DetailChild(
                child.Step.Map,
                child.Below.Image(child.Step.Map, child.Step.Lengthening),
                child.Step.Down,
                child.Step.Map == AffineMap.Identity ? -1 : child.Step.Index));
        var (baseBox, box) = (builder.OutlineAt(0).Box, builder.OutlineAt(level).Box);
        return new(box, StandIn(baseBox, box), [.. children]);
    }

    /// <summary>How the base mesh stands for what a box holds: as it is, where it lies within; else its maps have carried it away, and it is stretched to fill the box.</summary>
    private static AffineMap StandIn(BoundingBox baseBox, BoundingBox box) =>
        box.IsEmpty || BoundingBox.Union(box, baseBox).Diagonal <= Within * box.Diagonal ? AffineMap.Identity : InstanceTree.Between(baseBox, box);

    /// <summary>Sums have no levels: they are sorted into a tree of groups by their places.</summary>
    private static DetailTable OfSums(Fractal fractal)
    {
        var mesh = fractal.BaseMesh;
        var maps = mesh.FaceCount == 0 ? [] : FractalGenerator.Expand(fractal, FractalLimits.ComponentwiseSums);
        var tree = new InstanceTree(mesh.Bounds, [.. maps]);
        return new(tree.States, [new(0, tree.States.Length, 0, tree.States.Length)], tree.Root, mesh);
    }
}
