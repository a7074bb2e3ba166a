using System.Collections.Immutable;
using FractalEngine.Core.Bvh.Objects;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Core.DeepZoom;

/// <summary>
/// Finds where rays hit a fractal around a camera that is so deep in it that coordinates are relative to a sub-fractal, see
/// <see cref="FractalAddress"/>. Rays are in world axes about the camera, in the unit of the sub-fractals' maps.
/// </summary>
/// <remarks>
/// Rays are cast at the sub-fractals around the camera, from the one that it is in to those so large that nothing beyond them is seen.
/// So no ray climbs the levels above, however many there are. Each sub-fractal has the precision of its own size.
/// </remarks>
public sealed class DeepZoomRayCaster : InstanceRayCaster
{
    private readonly Fractal _fractal;
    private readonly FractalRayCaster _whole;

    /// <summary>Prepares a fractal, and the sub-fractals around a camera.</summary>
    /// <param name="fractal">In affine composition.</param>
    /// <param name="roots">See <see cref="FractalAddress.CollectRoots"/>; the nearest first.</param>
    /// <exception cref="ArgumentException">The fractal is composed componentwise.</exception>
    /// <exception cref="FractalLimitException">The bounds of some level overflow a double or don't converge.</exception>
    /// <exception cref="SingularMatrixException">A map has no inverse.</exception>
    /// <remarks>Cost: milliseconds. For other views of the same fractal see <see cref="WithRoots"/>.</remarks>
    public DeepZoomRayCaster(Fractal fractal, ImmutableArray<LodRoot> roots)
        : this(Checked(fractal), WholeOf(fractal), roots)
    {
    }

    private DeepZoomRayCaster(Fractal fractal, FractalRayCaster whole, ImmutableArray<LodRoot> roots)
        : base(BuildInstances(whole, roots), maxCoordinate: 0)
    {
        _fractal = fractal;
        _whole = whole;
        Roots = roots;
    }

    /// <inheritdoc/>
    public override long StorageBytes => _whole.StorageBytes;

    /// <summary>The sub-fractals that rays are cast at.</summary>
    public ImmutableArray<LodRoot> Roots { get; }

    /// <summary>The caster of the same fractal around another camera. It shares what is kept of the fractal.</summary>
    /// <param name="roots">See <see cref="FractalAddress.CollectRoots"/>; the nearest first.</param>
    /// <remarks>Cost: microseconds a root.</remarks>
    public DeepZoomRayCaster WithRoots(ImmutableArray<LodRoot> roots) => new(_fractal, _whole, roots);

    /// <summary>Computes the place of the instance that was hit last between the two colours of a gradient, from 0 to 1.</summary>
    /// <param name="gradient">Kind of the gradient; not <see cref="GradientKind.None"/>.</param>
    /// <param name="rootIndex">Index of the sub-fractal that was hit.</param>
    /// <param name="context">That of the query.</param>
    public float GradientFactorOf(GradientKind gradient, int rootIndex, QueryContext context)
    {
        ArgumentNullException.ThrowIfNull(context);
        var path = Roots[rootIndex].ColourPath;
        foreach (var (set, index) in _whole.SetsOf(Roots[rootIndex].State, context.InstancePath))
        {
            path = path.Append(set.Maps, index);
        }

        return path.ComputeGradientFactor(gradient, _fractal.LevelCount ?? long.MaxValue);
    }

    /// <summary>Computes what a gradient gives to the instance that was hit last.</summary>
    /// <param name="gradient">The gradient on the same fractal.</param>
    /// <param name="rootIndex">Index of the sub-fractal that was hit.</param>
    /// <param name="context">That of the query.</param>
    public GradientShade ShadeOf(InstanceGradient gradient, int rootIndex, QueryContext context)
    {
        ArgumentNullException.ThrowIfNull(gradient);
        ArgumentNullException.ThrowIfNull(context);
        var root = Roots[rootIndex];
        return gradient.ShadeOf(root.ColourPath, root.State, root.FrameToFractal, context.InstancePath);
    }

    /// <summary>Computes what the maps that lead to the instance that was hit last mix into its colour.</summary>
    /// <param name="rootIndex">Index of the sub-fractal that was hit.</param>
    /// <param name="context">That of the query.</param>
    public Tint TintOf(int rootIndex, QueryContext context)
    {
        ArgumentNullException.ThrowIfNull(context);
        return _whole.SetsOf(Roots[rootIndex].State, context.InstancePath).Aggregate(
            Roots[rootIndex].Tint, static (tint, step) => tint.Then(Tint.Of(step.Set.ColourOf(step.Index))));
    }

    private static Fractal Checked(Fractal fractal)
    {
        ArgumentNullException.ThrowIfNull(fractal);
        return fractal.Description.Composition == Composition.Affine
            ? fractal
            : throw new ArgumentException("expected a fractal in affine composition", nameof(fractal));
    }

    // Cameras come to levels that searches from the whole fractal skip.
    private static FractalRayCaster WholeOf(Fractal fractal) =>
        new(fractal.BuildHierarchy(doublesPowers: false, keepsAllLevels: true));

    private static ObjectBvh? BuildInstances(FractalRayCaster whole, ImmutableArray<LodRoot> roots)
    {
        var casters = new Dictionary<LevelState, FractalRayCaster>();
        var instances = new List<RayInstance>();
        for (var i = 0; i < roots.Length; i++)
        {
            var root = roots[i];
            var caster = casters.TryGetValue(root.State, out var known) ? known : casters[root.State] = whole.At(root.State);
            if (!caster.Box.IsEmpty)
            {
                instances.Add(new(i, new(caster), root.FrameToCamera, Widened(caster.Box.Transform(root.FrameToCamera))));
            }
        }

        return instances.Count == 0 ? null : ObjectBvh.Build(instances.ToArray());
    }

    private static BoundingBox Widened(BoundingBox box)
    {
        var margin = RoundingErrors.Chain * box.MaxAbsCoordinate() * Vector.One;
        return new(box.Minimum - margin, box.Maximum + margin);
    }
}
