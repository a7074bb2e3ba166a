using System.Runtime.Intrinsics;

namespace FractalEngine.Core.Visibility.Sky;

/// <summary>What one side of an instance sees of the sky, on the way from its own frame to the root's.</summary>
/// <param name="side">Index of the side.</param>
/// <param name="point">Point just before it: x, y, z, 0.</param>
internal struct SideVisibility(int side, Vector256<double> point)
{
    /// <summary>Index of the side of the instance.</summary>
    public int Side { get; } = side;

    /// <summary>Point just before the side, in the current frame: x, y, z, 0.</summary>
    public Vector256<double> Point { get; set; } = point;

    /// <summary>Normal of the side in the current frame, of any length: x, y, z, 0.</summary>
    public Vector256<double> Normal { get; set; } = AmbientCube.AxisOf(side);

    /// <summary>Whether the normal is another one than in the instance's frame.</summary>
    public bool IsTurned { get; set; }

    /// <summary>Free directions, in the frame in which masks were known last.</summary>
    public ulong Mask { get; set; } = ulong.MaxValue;
}
