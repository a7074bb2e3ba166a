using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Rows;

namespace FractalEngine.Core.Physics.Separation;

/// <summary>What a separation of overlapping bodies needs of a contact.</summary>
internal readonly struct SeparationGap
{
    // Relative to the smaller radius: at so small an overlap a displacement ends.
    private const double AimedOverlap = 1e-7;

    // More of an overlap is taken back at once, since others will push in again.
    private const double OverRelaxation = 1.3;

    /// <summary>Index of the body on the normal's side.</summary>
    public readonly int First;

    /// <summary>Index of the other body, or <see cref="ContactRow.Immovable"/>.</summary>
    public readonly int Second;

    /// <summary>Vector between the centres, or from the surface's point, before either body goes its way.</summary>
    public readonly Vector Offset;

    /// <summary>Unit vector of a surface's plane.</summary>
    public readonly Vector Normal;

    /// <summary>Length that the offset must keep.</summary>
    public readonly double MinDistance;

    /// <summary>Overlap that is left, scene units.</summary>
    public readonly double Negligible;

    /// <summary>Overlap at which a displacement ends, scene units.</summary>
    public readonly double Aimed;

    /// <summary>Part of an overlap that is taken back at once.</summary>
    public readonly double Relaxation;

    /// <summary>True where the offset counts along the normal only.</summary>
    public readonly bool IsPlane;

    /// <summary>True where the faster of two bodies gives way alone.</summary>
    public readonly bool IsOneSided;

    /// <summary>Takes from a contact what a separation needs.</summary>
    /// <param name="row">The contact.</param>
    public SeparationGap(in ContactRow row)
    {
        First = row.First;
        Second = row.Second;
        Offset = row.HasArms ? row.Offset + row.TurnShift - row.SurfaceDisplacement : row.Offset - row.SurfaceDisplacement;
        Normal = row.Normal;
        MinDistance = row.MinDistance;
        var unit = row.IsBall ? row.MinDistance * row.SmallerRadiusShare : 0;
        Negligible = OverlapSeparator.NegligibleOverlap * unit;
        Aimed = AimedOverlap * unit;
        Relaxation = row.IsBall && !row.IsAhead ? OverRelaxation : 1;
        IsPlane = !row.IsBall || row.HasFixedNormal;
        IsOneSided = row.IsBouncingAhead;
    }
}
