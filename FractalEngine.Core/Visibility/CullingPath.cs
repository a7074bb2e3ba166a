using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Core.Visibility;

/// <summary>The path of child instances that leads to a sub-fractal during culling.</summary>
/// <param name="Hash">Hash that tells the sub-fractal apart from others of its object.</param>
/// <param name="ColourPath">Path that decides about the colour; stays as it is where the object has no gradient.</param>
internal readonly record struct CullingPath(ulong Hash, ColourPath ColourPath)
{
    /// <summary>What the maps on the path mix into colours.</summary>
    public Vector128<float> MapTint { get; init; } = Tint.None.ToSingle();

    /// <summary>Sides of what the path leads to that are never seen, see <see cref="Levels.CoveredSides"/>.</summary>
    public int CoveredSides { get; init; }

    // Roots differ in bits that child indices do not reach.
    private const int RootShift = 40;

    /// <summary>Creates the path of a whole fractal, from which nothing has been appended.</summary>
    public static CullingPath Start => new(0, ColourPath.Start);

    /// <summary>Creates the path of one of several roots.</summary>
    /// <param name="index">Index of the root among those of its object.</param>
    /// <param name="colourPath">Path of maps that lead to the root.</param>
    /// <param name="tint">What the maps that lead to the root mix into colours.</param>
    public static CullingPath FromRoot(int index, ColourPath colourPath, Tint tint) =>
        new((ulong)(index + 1) << RootShift, colourPath) { MapTint = tint.ToSingle() };

    /// <summary>Appends one child instance to the path.</summary>
    /// <param name="childIndex">Index of the child instance among its siblings.</param>
    /// <param name="depth">Number of child instances in the path so far.</param>
    /// <param name="mapIndex">Index of the child's map in its set; −1 for the identity.</param>
    /// <param name="setSize">Number of maps of that set.</param>
    /// <param name="gradient">Gradient of the object.</param>
    /// <param name="childSides">The child's sides that are covered, and those that lie in a side of its parent.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public CullingPath Append(
        int childIndex, int depth, int mapIndex, int setSize, GradientKind gradient, (byte Covered, byte Shared) childSides) =>
        new(
            ((Hash ^ (ulong)(childIndex + 1)) * HashMixing.GoldenGamma) + (ulong)depth,
            gradient == GradientKind.None ? ColourPath : ColourPath.Append(mapIndex, setSize))
        {
            MapTint = MapTint,
            CoveredSides = childSides.Covered | (childSides.Shared & CoveredSides),
        };

    /// <summary>Appends the tint of a child instance to that of the path.</summary>
    public CullingPath WithTint(Vector128<float> tint) => this with
    {
        MapTint = (Vector128.Create(MapTint[3]) * tint) + MapTint.WithElement(3, 0),
    };
}
