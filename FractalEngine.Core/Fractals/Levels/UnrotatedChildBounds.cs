using System.Runtime.InteropServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Bvh.Boxes;
using FractalEngine.Core.Geometry.Hulls;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Fractals.Levels;

/// <summary>
/// Bounds children that are instances of one solid in any sizes, none of them rotated, as in Sierpiński's and Menger's fractals. One
/// support of the solid serves all of them, four at a time.
/// </summary>
/// <param name="childHull">Bounds each child in its own frame.</param>
/// <param name="children">The children, for which <see cref="HasNoRotation"/> holds.</param>
/// <param name="paddedCount">Their number, with those that fill the last vector.</param>
internal sealed class UnrotatedChildBounds(HullBound childHull, ChildInstance[] children, int paddedCount)
{
    private readonly double[] _translationsAndScales = VectorX4.CreateRows<ChildInstance>(
        children, 4, static child =>
        {
            var (x, y, z) = child.Map.Translation;
            return [x, y, z, child.Map.Linear.V1.X];
        });

    /// <summary>Number of bytes of the arrays.</summary>
    public long StorageBytes => (sizeof(double) * _translationsAndScales.Length) + 64;

    /// <summary>Tells whether all children are instances of one sub-fractal, moved and scaled but not rotated.</summary>
    public static bool HasNoRotation(ChildInstance[] children) => Array.TrueForAll(
        children, child => child.LevelStep == children[0].LevelStep && child.Map.Linear is var linear && linear.V1.X > 0
            && linear == linear.V1.X * Matrix.Identity);

    /// <summary>Creates the bounds of children without rotation; null for others.</summary>
    /// <param name="childHull">The hull of the sub-fractal that the children are instances of; null where boxes bound as well.</param>
    /// <param name="children">The children.</param>
    /// <param name="paddedCount">Number of children, rounded up to a multiple of four.</param>
    public static UnrotatedChildBounds? CreateOrNull(HullBound? childHull, ChildInstance[] children, int paddedCount) =>
        childHull is not null && HasNoRotation(children) ? new(childHull, children, paddedCount) : null;

    /// <summary>Queues all children by their boxes and by their support in one direction, which is best for positions outside.</summary>
    /// <param name="direction">From about the middle of all children to the position: x, y, z, 0.</param>
    /// <param name="directionLengthSquared">Squared length of the direction.</param>
    /// <param name="position">In the frame of the parent: x, y, z, 0.</param>
    /// <param name="childBoxes">See <see cref="SubFractal.ChildBounds"/>.</param>
    /// <param name="queue">The queue of the children.</param>
    public void FillQueue(
        Vector256<double> direction, double directionLengthSquared, Vector256<double> position, double[] childBoxes, in ChildQueue queue)
    {
        var unitDirection = direction * (1 / Math.Sqrt(directionLengthSquared));
        ref var translations = ref MemoryMarshal.GetArrayDataReference(_translationsAndScales);
        ref var boxes = ref MemoryMarshal.GetArrayDataReference(childBoxes);
        var positionX4 = VectorX4.Broadcast(position);
        var directionX4 = VectorX4.Broadcast(unitDirection);
        var height = Vector256.Create(Vector256.Dot(unitDirection, position));
        var support = Vector256.Create(childHull.Support(unitDirection));
        for (var i = 0; i < paddedCount; i += VectorX4.Count)
        {
            var bounds = BoxDistance.SquaredX4(ref boxes, paddedCount, i, positionX4, out var centreDistances);
            var translation = VectorX4.Load(ref translations, i, paddedCount);
            var separation = height - VectorX4.Dot(directionX4, translation)
                - (Vector256.LoadUnsafe(ref translations, (nuint)((3 * paddedCount) + i)) * support);
            separation = Vector256.MaxNative(separation, Vector256<double>.Zero);
            queue.SetBounds(Vector256.MaxNative(bounds, separation * separation), centreDistances, i);
        }
    }
}
