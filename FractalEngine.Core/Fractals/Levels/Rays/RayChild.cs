using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry.Rays;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels.Rays;

/// <summary>Leads a ray from the units of a <see cref="RayBounds"/> to those of a sub-fractal one or a few levels below.</summary>
internal readonly struct RayChild
{
    // A sub-fractal has at most 64 children.
    private const int BitsPerIndex = 6;

    private readonly SimdAffineMap _map;
    private readonly LevelStep _levelStep;
    private readonly ulong _path;

    /// <summary>Prepares a child for the rays that enter it.</summary>
    /// <param name="descendant">The sub-fractal and how it is reached.</param>
    /// <param name="parent">The box whose units the ray leaves.</param>
    /// <param name="entered">The box of the sub-fractal.</param>
    /// <param name="group">The bounds of the group that it stands for; null for a sub-fractal.</param>
    /// <param name="hasTestedPlanes">True where the bounds of the parent have the planes of the sub-fractal.</param>
    public RayChild(RayDescendant descendant, RayBox parent, RayBox entered, RayBounds? group, bool hasTestedPlanes)
    {
        var map = entered.ToUnits * descendant.Inverse * parent.FromUnits;
        _map = new(map);
        _levelStep = descendant.LevelStep;
        Group = group;
        HasTestedPlanes = hasTestedPlanes;
        PathLength = descendant.Path.Length;
        for (var i = 0; i < PathLength; i++)
        {
            _path |= (ulong)descendant.Path[i] << (BitsPerIndex * i);
        }

        var scale = map.Linear.V1.X;
        IsScaling = scale > 0 && map.Linear == Matrix.Diagonal(scale * Vector.One);
        Factors = IsScaling
            ? Vector256.Create(scale, scale, 1 / scale, 1 / scale)
            : Vector256.Create(
                1, descendant.InverseNorm * entered.InverseHalfExtent / parent.InverseHalfExtent,
                1, descendant.Norm * parent.InverseHalfExtent / entered.InverseHalfExtent);
        MayBeFar = !RayFrame.IsNear(descendant.Box, parent, map);
    }

    /// <summary>From the units of the parent to those of the sub-fractal.</summary>
    [System.Diagnostics.CodeAnalysis.UnscopedRef]
    public ref readonly SimdAffineMap Map => ref _map;

    /// <summary>True where the map scales all axes alike, by the first of the <see cref="Factors"/>, and does not rotate.</summary>
    public bool IsScaling { get; }

    /// <summary>True where a ray that enters the child's bounds may still be far from those of the sub-fractal.</summary>
    public bool MayBeFar { get; }

    /// <summary>True where a ray that enters the child's bounds hits the planes of the sub-fractal too.</summary>
    public bool HasTestedPlanes { get; }

    /// <summary>What leads to the <see cref="RayFrame.Factors"/> of the child, but for the length of the direction there.</summary>
    /// <remarks>Where the map is a scaling, all of them are known; elsewhere the second and the last are upper bounds.</remarks>
    public Vector256<double> Factors { get; }

    /// <summary>Number of child instances that lead to the sub-fractal.</summary>
    public int PathLength { get; }

    /// <summary>The bounds of a group of children; null where the child is an instance of a sub-fractal.</summary>
    public RayBounds? Group { get; }

    /// <summary>Computes the remaining levels of the sub-fractal.</summary>
    /// <param name="parentLevels">Remaining levels of the parent.</param>
    public long RemainingLevels(long parentLevels) => _levelStep.RemainingLevels(parentLevels);

    /// <summary>Writes the indices of the child instances that lead to the sub-fractal, the outermost first.</summary>
    /// <param name="path">At least <see cref="PathLength"/> indices.</param>
    public void CopyPath(Span<int> path)
    {
        for (var i = 0; i < PathLength; i++)
        {
            path[i] = (int)(_path >> (BitsPerIndex * i)) & ((1 << BitsPerIndex) - 1);
        }
    }
}
