using System.Collections.Immutable;
using FractalEngine.Core.Bvh.Objects;
using FractalEngine.Core.Queries;

namespace FractalEngine.Core.SceneQueries;

/// <summary>The objects of a <see cref="SceneCollider"/>: most in a hierarchy over their boxes, a few in a list. Immutable.</summary>
/// <remarks>
/// Moving an object costs O(log n) once the hierarchy is built. Few objects need none: a list is faster. Objects that are added stay in the
/// list until they are more than the square root of all, so that adding one by one builds few hierarchies.
/// </remarks>
/// <param name="hierarchy">Holds the first objects; null where all are in the list.</param>
/// <param name="loose">The objects behind those of the hierarchy, in the order of their indices.</param>
internal sealed class SceneObjects(ObjectBvh? hierarchy, ImmutableArray<ColliderInstance> loose)
{
    // A list as long as this costs less than the hierarchy beside it.
    private const int MinLoose = 8;

    /// <summary>Holds the first objects; null where all are in the list.</summary>
    public ObjectBvh? Hierarchy { get; } = hierarchy;

    /// <summary>The objects behind those of the hierarchy, in the order of their indices.</summary>
    public ImmutableArray<ColliderInstance> Loose { get; } = loose;

    /// <summary>Number of all objects.</summary>
    public int Count => HierarchyCount + Loose.Length;

    /// <summary>Whether queries would be slower than on <see cref="WithNewHierarchy"/>.</summary>
    public bool NeedsNewHierarchy => Hierarchy is null
        ? Loose.Length > QueryContext.MaxListedObjects
        : Loose.Length > Math.Max(MinLoose, Math.Sqrt(Count)) || Hierarchy.IsDegraded;

    private int HierarchyCount => Hierarchy?.Count ?? 0;

    /// <summary>The object with an index in the scene, found in O(log n).</summary>
    public ColliderInstance this[int index] =>
        index < HierarchyCount ? (ColliderInstance)Hierarchy!.LeafOf(index) : Loose[index - HierarchyCount];

    /// <summary>Collects objects without a hierarchy.</summary>
    /// <param name="instances">Each at its index.</param>
    public static SceneObjects Of(ImmutableArray<ColliderInstance> instances) => new(null, instances);

    /// <summary>Replaces the object with the same index.</summary>
    public SceneObjects With(ColliderInstance instance) => instance.Index < HierarchyCount
        ? new(Hierarchy!.With(instance), Loose)
        : new(Hierarchy, Loose.SetItem(instance.Index - HierarchyCount, instance));

    /// <summary>Appends an object, whose index must be the next.</summary>
    public SceneObjects Add(ColliderInstance instance) => new(Hierarchy, Loose.Add(instance));

    /// <summary>The same objects with a hierarchy of all, O(n log n).</summary>
    public SceneObjects WithNewHierarchy() => new(ObjectBvh.Build(ToArray()), []);

    /// <summary>Lists all objects, each at its index.</summary>
    public ColliderInstance[] ToArray()
    {
        var instances = new ColliderInstance[Count];
        Hierarchy?.CopyTo<ColliderInstance>(instances);
        Loose.CopyTo(instances, HierarchyCount);
        return instances;
    }
}
