using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Visibility;

/// <summary>What one side of an instance sees of the sky, on the way from its own frame to the root's.</summary>
internal struct SkySight
{
    /// <summary>Begins in the frame of an instance.</summary>
    /// <param name="side">Index of the side.</param>
    /// <param name="point">Point just before it: x, y, z, 0.</param>
    public SkySight(int side, Vector256<double> point)
    {
        Side = side;
        Point = point;
        Normal = SkySides.AxisOf(side);
        Mask = ulong.MaxValue;
    }

    /// <summary>Index of the side of the instance.</summary>
    public int Side { get; }

    /// <summary>Point just before the side, in the current frame: x, y, z, 0.</summary>
    public Vector256<double> Point { get; set; }

    /// <summary>Normal of the side in the current frame, of any length: x, y, z, 0.</summary>
    public Vector256<double> Normal { get; set; }

    /// <summary>Whether the normal is another one than in the instance's frame.</summary>
    public bool IsTurned { get; set; }

    /// <summary>Free directions, in the frame in which masks were known last.</summary>
    public ulong Mask { get; set; }
}
