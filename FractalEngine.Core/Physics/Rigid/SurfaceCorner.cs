using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics.Rigid;

/// <summary>A corner of a body's surface.</summary>
/// <param name="Position">In the frame that is meant.</param>
/// <param name="Inwards">The sum of the edges from there.</param>
/// <param name="Rounding">How far the surface is from the corner, scene units: that of a ball is its centre.</param>
/// <param name="Triangle">Index in the leaf of the triangle that it is given to.</param>
internal readonly record struct SurfaceCorner(Vector Position, Vector Inwards, double Rounding, int Triangle)
{
    /// <summary>The corner where a placement has it.</summary>
    public SurfaceCorner Place(in SurfaceMotion placement)
    {
        var map = placement.Map;
        return new(map * Position, map.Linear * Inwards, placement.Scale * Rounding, Triangle);
    }
}
