namespace FractalEngine.Core.Visibility;

/// <summary>The result of culling one strip of a frame: instances, in the order of the objects, and statistics.</summary>
internal sealed class StripOutput
{
    private ObjectEnd[] _ends = [];
    private CullingStatistics _statistics;
    private int _objectCount;

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
    /// <param name="objectCount">Number of objects of the frame.</param>
    public void Clear(int objectCount)
    {
        if (_ends.Length < objectCount)
        {
            _ends = new ObjectEnd[objectCount];
        }

        _objectCount = 0;
        _statistics = default;
        IsNearClipped = false;
        IsOverBudget = false;
        Instances.Clear();
        SharedInstances.Clear();
    }

    /// <summary>Ends the results of one object; those of the next one follow.</summary>
    public void EndObject()
    {
        _ends[_objectCount] = new(Instances.Count, SharedInstances.Count, IsNearClipped);
        _objectCount++;
        IsNearClipped = false;
    }

    /// <summary>The range of an object's instances in <see cref="Instances"/>.</summary>
    /// <param name="rank">Rank of the object in the order of culling.</param>
    public (int Start, int Count) InstancesOf(int rank)
    {
        var start = rank == 0 ? 0 : _ends[rank - 1].Instances;
        return (start, _ends[rank].Instances - start);
    }

    /// <summary>The range of an object's instances in <see cref="SharedInstances"/>.</summary>
    /// <param name="rank">Rank of the object in the order of culling.</param>
    public (int Start, int Count) SharedInstancesOf(int rank)
    {
        var start = rank == 0 ? 0 : _ends[rank - 1].SharedInstances;
        return (start, _ends[rank].SharedInstances - start);
    }

    /// <summary>Tells whether the near plane or a section plane clips an instance of an object.</summary>
    /// <param name="rank">Rank of the object in the order of culling.</param>
    public bool HasNearClippedInstance(int rank) => _ends[rank].IsNearClipped;

    private readonly record struct ObjectEnd(int Instances, int SharedInstances, bool IsNearClipped);
}
