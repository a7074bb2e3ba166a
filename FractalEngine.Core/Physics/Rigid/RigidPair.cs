namespace FractalEngine.Core.Physics.Rigid;

/// <summary>Two surfaces that may meet in a part of a step.</summary>
/// <param name="First">Index of the first one, which is a body.</param>
/// <param name="Second">Index of the second one.</param>
/// <param name="Distance">The distance at which they rest on each other, scene units.</param>
internal readonly record struct RigidPair(int First, int Second, double Distance)
{
    /// <summary>Names the two, in any step.</summary>
    public long Key => ((long)First << 32) | (uint)Second;
}
