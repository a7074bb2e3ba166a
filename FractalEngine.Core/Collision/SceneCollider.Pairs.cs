using FractalEngine.Core.Fractals;

namespace FractalEngine.Core.Collision;

/// <content>Questions about two objects.</content>
public sealed partial class SceneCollider
{
    /// <summary>Finds the closest points of two objects, as colliders do for two shapes.</summary>
    /// <param name="objectIndex">Index of the first object in the scene, from 0.</param>
    /// <param name="otherObjectIndex">Index of the second object.</param>
    /// <param name="context">Receives the costs; null where they don't matter.</param>
    /// <returns>Both points in world space.</returns>
    /// <exception cref="ArgumentOutOfRangeException">There is no object with such an index.</exception>
    /// <exception cref="InvalidOperationException">An object has no faces.</exception>
    /// <exception cref="FractalLimitException">The distance is beyond the range of a double.</exception>
    /// <exception cref="NotSupportedException">The colliders are not exact.</exception>
    public ClosestPair FindClosestPair(int objectIndex, int otherObjectIndex, QueryContext? context = null)
    {
        var objects = _objects.ToArray();
        var instance = Instance(objectIndex, nameof(objectIndex));
        var other = Instance(otherObjectIndex, nameof(otherObjectIndex));
        return instance.Collider.Value.FindClosestPair(instance.ObjectToWorld, other.Collider.Value, other.ObjectToWorld, context);

        ColliderInstance Instance(int index, string name)
        {
            ArgumentOutOfRangeException.ThrowIfNegative(index, name);
            ArgumentOutOfRangeException.ThrowIfGreaterThanOrEqual(index, objects.Length, name);
            return objects[index];
        }
    }
}
