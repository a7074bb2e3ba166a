using System.Runtime.CompilerServices;
using System.Runtime.Intrinsics;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Rays;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Bvh.Objects;

/// <summary>A node of an <see cref="ObjectBvh"/> with up to four children and their boxes, one in each lane. Immutable.</summary>
/// <remarks>
/// Boxes are rounded outwards to single precision: among many objects a query waits for memory. The boxes of missing children are empty.
/// </remarks>
internal sealed class ObjectBvhNode
{
    /// <summary>The largest number of children.</summary>
    public const int Width = 4;

    private Vector128<float> _minX = Vector128.Create(float.PositiveInfinity);
    private Vector128<float> _minY = Vector128.Create(float.PositiveInfinity);
    private Vector128<float> _minZ = Vector128.Create(float.PositiveInfinity);
    private Vector128<float> _maxX = Vector128.Create(float.NegativeInfinity);
    private Vector128<float> _maxY = Vector128.Create(float.NegativeInfinity);
    private Vector128<float> _maxZ = Vector128.Create(float.NegativeInfinity);
    private Children _children;

    /// <summary>Creates a node over other nodes and leaves.</summary>
    /// <param name="children">Nodes or leaves, from one to four.</param>
    public ObjectBvhNode(params ReadOnlySpan<object> children)
    {
        ChildCount = children.Length;
        for (var slot = 0; slot < children.Length; slot++)
        {
            SetChild(slot, children[slot]);
        }
    }

    /// <summary>Number of children. They have the slots from 0.</summary>
    public int ChildCount { get; }

    /// <summary>The box that holds all children.</summary>
    public BoundingBox Box
    {
        get
        {
            var box = BoundingBox.Empty;
            for (var slot = 0; slot < ChildCount; slot++)
            {
                box = BoundingBox.Union(box, BoxOf(slot));
            }

            return box;
        }
    }

    /// <summary>The child in a slot: a node or a leaf.</summary>
    public object this[int slot] => _children[slot]!;

    /// <summary>A box that holds the child in a slot; larger by less than a part in 2²² of its coordinates.</summary>
    public BoundingBox BoxOf(int slot) => new(new(_minX[slot], _minY[slot], _minZ[slot]), new(_maxX[slot], _maxY[slot], _maxZ[slot]));

    /// <summary>Creates the same node with another child in one slot.</summary>
    public ObjectBvhNode With(int slot, object child)
    {
        var copy = (ObjectBvhNode)MemberwiseClone();
        copy.SetChild(slot, child);
        return copy;
    }

    /// <summary>Computes lower bounds on the distances of a position from the boxes of all children: infinite for missing ones.</summary>
    /// <remarks>
    /// Operation for operation the root of <see cref="BoundingBox.DistanceSquared"/> for a box that is larger. All these operations are
    /// monotone, so that rounding makes none exceed the distance from the child's own box.
    /// </remarks>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector256<double> DistanceBounds(Vector position)
    {
        var x = DistancesAlongAxis(_minX, _maxX, position.X);
        var y = DistancesAlongAxis(_minY, _maxY, position.Y);
        var z = DistancesAlongAxis(_minZ, _maxZ, position.Z);
        return Vector256.Sqrt((x * x) + (y * y) + (z * z));
    }

    /// <summary>Computes where a ray enters the boxes of all children at the soonest: NaN for those that it misses.</summary>
    /// <param name="ray">In world space.</param>
    /// <param name="maxDistance">The largest distance that counts.</param>
    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    public Vector256<double> RayEntries(in ObjectRay ray, double maxDistance)
    {
        var near = Vector256<double>.Zero;
        var far = Vector256.Create(maxDistance - ray.Start);
        ray.Clip(0, Widen(_minX), Widen(_maxX), ref near, ref far);
        ray.Clip(1, Widen(_minY), Widen(_maxY), ref near, ref far);
        ray.Clip(2, Widen(_minZ), Widen(_maxZ), ref near, ref far);
        return Vector256.ConditionalSelect(
            Vector256.LessThanOrEqual(near, far), near + Vector256.Create(ray.Start), Vector256.Create(double.NaN));
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<double> DistancesAlongAxis(Vector128<float> minimum, Vector128<float> maximum, double position)
    {
        var positions = Vector256.Create(position);
        return Vector256.MaxNative(Vector256.MaxNative(Widen(minimum) - positions, positions - Widen(maximum)), Vector256<double>.Zero);
    }

    [MethodImpl(MethodImplOptions.AggressiveInlining)]
    private static Vector256<double> Widen(Vector128<float> values) => Vector256.WidenLower(values.ToVector256Unsafe());

    private void SetChild(int slot, object child)
    {
        _children[slot] = child;
        var box = child is ObjectBvhNode node ? node.Box : ((ObjectBvhLeaf)child).Bounds;
        _minX = _minX.WithElement(slot, RoundDown(box.Minimum.X));
        _minY = _minY.WithElement(slot, RoundDown(box.Minimum.Y));
        _minZ = _minZ.WithElement(slot, RoundDown(box.Minimum.Z));
        _maxX = _maxX.WithElement(slot, -RoundDown(-box.Maximum.X));
        _maxY = _maxY.WithElement(slot, -RoundDown(-box.Maximum.Y));
        _maxZ = _maxZ.WithElement(slot, -RoundDown(-box.Maximum.Z));
    }

    /// <summary>The largest single-precision number that is not above a number.</summary>
    private static float RoundDown(double value)
    {
        var rounded = (float)value;
        return rounded > value ? MathF.BitDecrement(rounded) : rounded;
    }

    [InlineArray(Width)]
    private struct Children
    {
        private object? _first;
    }
}
