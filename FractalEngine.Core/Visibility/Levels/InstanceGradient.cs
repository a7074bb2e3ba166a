using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Core.Visibility.Levels;

/// <summary>Tells where the instances of one fractal stand in a gradient, and the mean colour of what each proxy stands for.</summary>
/// <remarks>
/// By level the mean is exact, weighted by areas. By other kinds, positions of a sub-fractal in the gradient are taken to fill an
/// interval that holds them evenly: the error is at most the largest difference of two colours within it, and mostly far less. The
/// interval of an orbit trap is that of 1,024 levels where there are more.
/// </remarks>
public sealed class InstanceGradient
{
    // A fractal of more levels is taken for one without end, whose proxies have the colour of their own level.
    private const long MaxLevels = 1024;

    // Areas of wide sets multiply with each level.
    private const double MaxWeight = 1e200;

    private readonly LodHierarchy _hierarchy;
    private readonly BoundingBox _bounds;
    private readonly long _colourLevels;

    // By remaining levels, then by the number of maps within one wave; empty where the path itself tells.
    private readonly GradientShade[][] _levelMeans;

    // By remaining levels, of an orbit trap: holds all places to which further maps carry the centre, in the frame of the sub-fractal.
    private readonly BoundingBox[] _passages;

    /// <summary>Prepares a gradient on a fractal.</summary>
    /// <param name="gradient">The gradient, of any kind but <see cref="GradientKind.None"/>.</param>
    /// <param name="hierarchy">That of a fractal in affine composition.</param>
    /// <exception cref="ArgumentException">The hierarchy is that of something else.</exception>
    /// <remarks>Cost: a pass over the levels, at most 1,024.</remarks>
    public InstanceGradient(Gradient gradient, LodHierarchy hierarchy)
    {
        ArgumentNullException.ThrowIfNull(gradient);
        ArgumentNullException.ThrowIfNull(hierarchy);
        Gradient = gradient;
        _hierarchy = hierarchy;
        _bounds = hierarchy.WholeBounds ?? throw new ArgumentException("expected a fractal in affine composition", nameof(hierarchy));
        _colourLevels = hierarchy.ColourLevels;
        _levelMeans = gradient.Kind == GradientKind.Level && hierarchy.LevelCount <= MaxLevels ? ComputeLevelMeans() : [];
        _passages = gradient.Kind == GradientKind.Trap ? ComputePassages() : [];
    }

    /// <summary>The gradient that was prepared.</summary>
    public Gradient Gradient { get; }

    /// <summary>True where the places of instances count, and not only their paths.</summary>
    internal bool NeedsPlaces => Gradient.Kind >= GradientKind.Height;

    /// <summary>Prepares what a gradient needs.</summary>
    /// <param name="gradient">The gradient; null for none.</param>
    /// <param name="hierarchy">That of the model.</param>
    /// <returns>Null where the gradient needs nothing, or the hierarchy is not that of a fractal in affine composition.</returns>
    public static InstanceGradient? CreateOrNull(Gradient? gradient, LodHierarchy hierarchy)
    {
        ArgumentNullException.ThrowIfNull(hierarchy);
        return gradient is { IsPlain: false, Kind: not GradientKind.None } && hierarchy.WholeBounds is not null
            ? new(gradient, hierarchy) : null;
    }

    /// <summary>Prepares what a gradient on a fractal needs, and builds the fractal's hierarchy for it.</summary>
    /// <param name="gradient">The gradient; null for none.</param>
    /// <param name="model">Shows the fractal; its name is part of what an exception says.</param>
    /// <returns>Null where the gradient needs nothing, or the fractal is not in affine composition.</returns>
    /// <exception cref="FractalLimitException">The bounds of some level overflow a double, or don't converge.</exception>
    /// <exception cref="SingularMatrixException">A map has no inverse.</exception>
    public static InstanceGradient? CreateOrNull(Gradient? gradient, FractalModel model)
    {
        ArgumentNullException.ThrowIfNull(model);
        return gradient is null or { IsPlain: true } || model.Fractal.Description.Composition != Composition.Affine
            ? null : CreateOrNull(gradient, model.Named(LodHierarchy.Build));
    }

    /// <summary>Computes what an instance gets to which a query has led, or the proxy of a sub-fractal.</summary>
    /// <param name="instancePath">For each level, the outermost first, the index of the map in its set.</param>
    public GradientShade ShadeOf(ReadOnlySpan<int> instancePath) =>
        ShadeOf(ColourPath.Start, _hierarchy.Source!.HierarchyBySets.Top, AffineMap.Identity, instancePath);

    /// <summary>Computes what an instance or a proxy gets to which a path leads from a sub-fractal on.</summary>
    /// <param name="path">The path of maps to the sub-fractal.</param>
    /// <param name="start">The place of the sub-fractal.</param>
    /// <param name="toFractal">Map from its frame to that of the fractal.</param>
    /// <param name="instancePath">The rest of the path.</param>
    internal GradientShade ShadeOf(ColourPath path, LevelState start, AffineMap toFractal, ReadOnlySpan<int> instancePath)
    {
        var level = start.Level;
        foreach (var (set, index, next) in _hierarchy.Source!.HierarchyBySets.Follow(start, instancePath) ?? [])
        {
            level = next;
            toFractal *= set.Maps[index];
            var longer = path.Append(set.Maps, index);
            path = longer == path ? path : longer.PassBy(toFractal * _bounds.Centre, _bounds);
        }

        return ShadeOf(in path, _hierarchy.NodeAt(level), level, new(toFractal));
    }

    /// <summary>Notes where a path has carried the centre of the fractal.</summary>
    /// <param name="path">The path, with the last map.</param>
    /// <param name="toFractal">Map from the frame of the sub-fractal to that of the fractal.</param>
    internal ColourPath PassBy(in ColourPath path, in SimdAffineMap toFractal) => path.PassBy(toFractal.Apply(_bounds.Centre), _bounds);

    /// <summary>Computes what an instance gets, or the proxy of a sub-fractal.</summary>
    /// <param name="path">The path of maps that lead to it.</param>
    /// <param name="node">What stands there.</param>
    /// <param name="level">Remaining levels there.</param>
    /// <param name="toFractal">Map from its frame to that of the fractal; any where places do not count.</param>
    internal GradientShade ShadeOf(in ColourPath path, LodNode node, long level, in SimdAffineMap toFractal)
    {
        if (Gradient.Kind == GradientKind.Level)
        {
            return level < _levelMeans.Length
                ? _levelMeans[level][path.MapCount % _levelMeans[level].Length]
                : ShadeAt(path.ComputeGradientFactor(GradientKind.Level, _colourLevels));
        }

        var (from, to) = IntervalOf(in path, node, level, in toFractal);
        from = double.IsFinite(from) ? Math.Clamp(from, 0, 1) : 0;
        to = double.IsFinite(to) ? Math.Clamp(to, from, 1) : from;
        return new(0.5 * (from + to), Gradient.Palette?.MeanOver(from, to) ?? Vector.Zero);
    }

    private GradientShade ShadeAt(double factor) => new(factor, Gradient.Palette?.ColourAt(factor) ?? Vector.Zero);

    /// <summary>The positions in the gradient between which the instances of a sub-fractal lie; of any kind but by level.</summary>
    internal (double From, double To) IntervalOf(in ColourPath path, LodNode node, long level, in SimdAffineMap toFractal)
    {
        var isInstance = node.ChildMaps.Length == 0;
        if (Gradient.Kind == GradientKind.Path)
        {
            var rest = isInstance ? 0 : path.RemainingWeight * (1 - Math.Pow(2, -level));
            return (path.PathFraction, path.PathFraction + rest);
        }

        var isTrap = Gradient.Kind == GradientKind.Trap;
        var box = isTrap ? _passages[Math.Min(level, _passages.Length - 1)] : node.Box;
        var offset = toFractal.Apply(box.Centre) - _bounds.Centre;
        var half = isInstance
            ? Vector.Zero : SimdAffineMap.ToVector(toFractal.TransformHalfSize(SimdAffineMap.ToVector256(0.5 * box.Size)));
        if (Gradient.Kind == GradientKind.Height)
        {
            var (middle, size) = (offset.Y + (0.5 * _bounds.Size.Y), _bounds.Size.Y);
            return ((middle - half.Y) / size, (middle + half.Y) / size);
        }

        var nearest = 2 * Vector.Max(offset.Absolute() - half, Vector.Zero).Length() / _bounds.Diagonal;
        return !isTrap ? (nearest, 2 * (offset.Absolute() + half).Length() / _bounds.Diagonal)
            : (isInstance ? path.NearestApproach : Math.Min(nearest, path.NearestApproach), path.NearestApproach);
    }

    /// <summary>Computes for each level where further maps may carry the centre, from the levels below.</summary>
    private BoundingBox[] ComputePassages()
    {
        var passages = new BoundingBox[Math.Min(_hierarchy.LevelCount, MaxLevels) + 1];
        for (var level = 0; level < passages.Length; level++)
        {
            passages[level] = BoundingBox.Empty;
            var node = _hierarchy.NodeAt(level);
            for (var i = 0; i < node.ChildMaps.Length; i++)
            {
                var within = passages[node.ChildLevelSteps[i].RemainingLevels(level)].Including(_bounds.Centre);
                passages[level] = BoundingBox.Union(passages[level], within.Transform(node.ChildMaps[i].ToAffineMap()));
            }
        }

        return passages;
    }

    /// <summary>Computes the mean of each level for each number of maps before it, from those of the levels below.</summary>
    private GradientShade[][] ComputeLevelMeans()
    {
        var wave = 2 * ColourPath.SweepLevels(_colourLevels);
        var means = new GradientShade[_hierarchy.LevelCount + 1][];
        var weights = new double[means.Length];
        for (var level = 0; level < means.Length; level++)
        {
            var node = _hierarchy.NodeAt(level);
            means[level] = new GradientShade[wave];
            if (node.ChildMaps.Length == 0)
            {
                weights[level] = node.IsEmpty ? 0 : 1;
                for (var count = 0; count < wave; count++)
                {
                    means[level][count] = ShadeAt(
                        (ColourPath.Start with { MapCount = count }).ComputeGradientFactor(GradientKind.Level, _colourLevels));
                }

                continue;
            }

            for (var i = 0; i < node.ChildMaps.Length; i++)
            {
                var child = node.ChildLevelSteps[i].RemainingLevels(level);
                var area = Math.Pow(Math.Abs(node.ChildMaps[i].ToAffineMap().Linear.Determinant()), 2.0 / 3);
                var weight = weights[child] * area * (node.Pick?.ShareOf(level, i) ?? 1);
                var step = node.ChildMapIndices[i] < 0 ? 0 : 1;
                weights[level] += weight;
                for (var count = 0; count < wave && weights[level] > 0; count++)
                {
                    var (factor, colour) = means[child][(count + step) % wave];
                    var (meanFactor, meanColour) = means[level][count];
                    var part = weight / weights[level];
                    means[level][count] = new(
                        meanFactor + (part * (factor - meanFactor)), meanColour + (part * (colour - meanColour)));
                }
            }

            if (weights[level] is not 0 and not (> 1 / MaxWeight and < MaxWeight))
            {
                return means[..level];
            }
        }

        return means;
    }
}
