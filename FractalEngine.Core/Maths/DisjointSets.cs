namespace FractalEngine.Core.Maths;

/// <summary>Sets of indices that are joined two by two (union–find). The lowest index stands for its set, whatever the order.</summary>
internal sealed class DisjointSets
{
    private int[] _parents = [];
    private bool[] _isJoined = [];

    // Number of indices that have been put into sets.
    private int _count;

    /// <summary>Makes room for indices.</summary>
    public void Reserve(int count)
    {
        if (count <= _parents.Length)
        {
            return;
        }

        _parents = new int[count];
        _isJoined = new bool[count];
        _count = 0;
    }

    /// <summary>Puts each index into a set of its own.</summary>
    /// <param name="count">Number of indices, for which room is made.</param>
    public void Reset(int count)
    {
        Reserve(count);
        // While none is joined, each is its own set.
        for (var i = JoinedCount > 0 ? 0 : _count; i < count; i++)
        {
            _parents[i] = i;
            _isJoined[i] = false;
        }

        _count = JoinedCount > 0 ? count : Math.Max(_count, count);
        JoinedCount = 0;
    }

    /// <summary>Joins the sets of two indices.</summary>
    public void Join(int first, int second)
    {
        JoinedCount += (_isJoined[first] ? 0 : 1) + (_isJoined[second] ? 0 : 1);
        _isJoined[first] = true;
        _isJoined[second] = true;
        if (_parents[first] == _parents[second])
        {
            return;
        }

        var root1 = RootOf(first);
        var root2 = RootOf(second);
        _parents[Math.Max(root1, root2)] = Math.Min(root1, root2);
    }

    /// <summary>Number of indices that are not alone in their sets.</summary>
    public int JoinedCount { get; private set; }

    /// <summary>True for an index that is not alone in its set.</summary>
    public bool IsJoined(int index) => _isJoined[index];

    /// <summary>The lowest index of a set.</summary>
    public int RootOf(int index)
    {
        while (_parents[index] != index)
        {
            _parents[index] = _parents[_parents[index]];
            index = _parents[index];
        }

        return index;
    }
}
