namespace FractalEngine.Core.Visibility;

/// <summary>The result of culling one strip of a frame: instances, in the order of the objects, and statistics.</summary>
internal sealed class StripOutput
{
    private readonly List<bool> _areNearClipped = [];
    private CullingStatistics _statistics;

    /// <summary>Instances that lie within the strip: rows of 3×4 maps from the drawn mesh's frame to world axes about the camera.</summary>
    public InstanceList Instances { get; } = new(hasPathHashes: false);

    /// <summary>Instances that other strips may have as well, with hashes that tell them apart.</summary>
    public InstanceList SharedInstances { get; } = new(hasPathHashes: true);

    /// <summary>Statistics of the strip.</summary>
    public ref CullingStatistics Statistics => ref _statistics;

    /// <summary>Whether the near plane or a section plane clips an instance of the current object.</summary>
    public bool IsNearClipped { get; set; }

    /// <summary>Whether the strip gave up because it exceeded its budget.</summary>
    public bool IsOverBudget { get; set; }

    /// <summary>Number of instances found so far, shared ones included.</summary>
    public int InstanceCount => Instances.Count + SharedInstances.Count;

    /// <summary>Removes all results, and keeps the memory.</summary>
    public void Clear()
    {
        _areNearClipped.Clear();
        _statistics = default;
        IsNearClipped = false;
        IsOverBudget = false;
        Instances.Clear();
        SharedInstances.Clear();
    }

    /// <summary>Ends the results of one object; those of the next one follow.</summary>
    public void EndObject()
    {
        Instances.EndObject();
        SharedInstances.EndObject();
        _areNearClipped.Add(IsNearClipped);
        IsNearClipped = false;
    }

    /// <summary>Tells whether the near plane or a section plane clips an instance of an object.</summary>
    /// <param name="rank">Rank of the object in the order of culling.</param>
    public bool HasNearClippedInstance(int rank) => _areNearClipped[rank];
}
