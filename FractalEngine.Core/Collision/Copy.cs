using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Collision;

/// <summary>A copy that a sub-fractal makes of one further down, by one map after another. Shared by all sub-fractals that make it alike.</summary>
internal sealed class Copy
{
    private readonly AffineMap _inverse;
    private readonly Vector256<double> _inverse1;
    private readonly Vector256<double> _inverse2;
    private readonly Vector256<double> _inverse3;
    private readonly Vector256<double> _inverseTranslation;

    /// <summary>By steps, at least one.</summary>
    public Copy(CopyStep[] steps)
    {
        Steps = steps;
        (Map, _inverse, ScaleSquared, Lengthening) = (AffineMap.Identity, AffineMap.Identity, 1, 1);
        foreach (var (set, index, down) in steps)
        {
            Map *= set.Maps[index];
            _inverse = set.Inverses[index] * _inverse;
            ScaleSquared *= set.ScaleSquared[index];
            Lengthening *= set.Lengthening[index];
            // Levels that are left say so, whatever was above; else levels that it goes down add up.
            Down = down < 0 ? down : Down < 0 ? ~(~Down - down) : Down + down;
        }

        (_inverse1, _inverse2) = (Lanes(_inverse.Linear.V1), Lanes(_inverse.Linear.V2));
        (_inverse3, _inverseTranslation) = (Lanes(_inverse.Linear.V3), Lanes(_inverse.Translation));
    }

    /// <summary>The maps, the outermost first.</summary>
    public CopyStep[] Steps { get; }

    /// <summary>From the copy's frame to that of the level.</summary>
    public AffineMap Map { get; }

    /// <summary>Back.</summary>
    public ref readonly AffineMap Inverse => ref _inverse;

    /// <summary>Square of the factor by which the map lengthens, where it is a similarity.</summary>
    public double ScaleSquared { get; }

    /// <summary>The most by which the map lengthens.</summary>
    public double Lengthening { get; }

    /// <summary>As in <see cref="CopyStep"/>.</summary>
    public long Down { get; }

    /// <summary>A position of the level's frame in the copy's: x, y, z, 0.</summary>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector256<double> ToLocal(Vector256<double> position) =>
        ((position[0] * _inverse1) + (position[1] * _inverse2) + (position[2] * _inverse3)) + _inverseTranslation;

    /// <summary>The levels left in the copy, for a sub-fractal that has so many.</summary>
    public long LevelsLeft(long levels) => Down < 0 ? ~Down : levels - Down;

    /// <summary>Bytes of the numbers.</summary>
    public long StorageBytes => (43 * sizeof(double)) + (24 * Steps.Length) + 40;

    private static Vector256<double> Lanes(Vector v) => Vector256.Create(v.X, v.Y, v.Z, 0);
}

/// <summary>One map of a <see cref="Copy"/>.</summary>
/// <param name="Set">Whose map it is.</param>
/// <param name="Index">Of the map in the set.</param>
/// <param name="Down">
/// How many levels it goes down: 1, and 1 more for each level that is passed over by its identity. Where a whole repetition is
/// passed over, the number of levels that are left below it, as its bitwise complement.
/// </param>
internal readonly record struct CopyStep(CopySet Set, int Index, long Down)
{
    /// <summary>The map.</summary>
    public AffineMap Map => Set.Maps[Index];

    /// <summary>The most by which the map lengthens.</summary>
    public double Lengthening => Set.Lengthening[Index];

    /// <summary>A copy of what is below a repetition, as it stands.</summary>
    public static CopyStep Past(long levelsLeft) => new(CopySet.Identity, 0, ~levelsLeft);

    /// <summary>The levels left below it, for a level that has so many.</summary>
    public long LevelsLeft(long levels) => Down < 0 ? ~Down : levels - Down;
}
