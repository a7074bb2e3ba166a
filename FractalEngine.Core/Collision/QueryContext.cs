using System.Runtime.InteropServices;
using FractalEngine.Core.Collision.Fractals;
using FractalEngine.Core.Collision.Reference;

namespace FractalEngine.Core.Collision;

/// <summary>
/// What a query cost, and which instance it found. The caller makes one, passes it to as many queries as it likes, one thread at a time,
/// and reads it in between: there are no counters that anybody else could see.
/// </summary>
public sealed class QueryContext
{
    private readonly List<int> _instancePath = new(64);
    private readonly List<int> _savedPath = new(64);
    private int[] _pathBuffer = [];
    private int[] _bestPathBuffer = [];
    private double[] _scratch = [];
    private double[] _objectBounds = [];
    private ExpandedChildren? _expandedChildren;
    private DescentBeam? _descentBeam;

    /// <summary>How many faces were looked at: the paper's collision cost (§5.2.3). Added up until <see cref="Reset"/>.</summary>
    public long FaceTests { get; set; }

    /// <summary>How many bounding volumes were looked at. Added up until <see cref="Reset"/>.</summary>
    public long BoundTests { get; set; }

    /// <summary>
    /// The instance that the last query found: for each level, the outermost first, the number of the transformation in its set. Empty for
    /// a mesh. Shorter than the fractal's depth where deeper levels are below the precision of the answer.
    /// </summary>
    public ReadOnlySpan<int> InstancePath => CollectionsMarshal.AsSpan(_instancePath);

    /// <summary>Sets the counters to zero.</summary>
    public void Reset() => (FaceTests, BoundTests) = (0, 0);

    /// <summary>Room for the way of a search; kept for the next one, and what is there stays.</summary>
    internal Span<int> PathBuffer(int length) => EnsureLength(ref _pathBuffer, length);

    /// <summary>Room for the way to the best so far.</summary>
    internal Span<int> BestPathBuffer(int length) => EnsureLength(ref _bestPathBuffer, length);

    /// <summary>Of searches that take long; made by the first.</summary>
    internal ExpandedChildren ExpandedChildren => _expandedChildren ??= new();

    /// <summary>Of descents in several copies; made by the first.</summary>
    internal DescentBeam DescentBeam => _descentBeam ??= new();

    /// <summary>Room for numbers of a search; kept for the next one.</summary>
    internal Span<double> ScratchBuffer(int length) => _scratch.Length >= length ? _scratch : _scratch = new double[length];

    /// <summary>Room for a bound of each object of a scene.</summary>
    internal Span<double> ObjectBoundsBuffer(int count)
    {
        if (_objectBounds.Length < count)
        {
            _objectBounds = new double[count];
        }

        return _objectBounds.AsSpan(0, count);
    }

    /// <summary>Keeps the present path while other objects are asked.</summary>
    internal void SavePath()
    {
        _savedPath.Clear();
        _savedPath.AddRange(InstancePath);
    }

    /// <summary>Makes the path that was kept the present one again.</summary>
    internal void RestorePath()
    {
        _instancePath.Clear();
        _instancePath.AddRange(CollectionsMarshal.AsSpan(_savedPath));
        _savedPath.Clear();
    }

    internal void ClearPath() => _instancePath.Clear();

    internal void AppendToPath(int mapIndex) => _instancePath.Add(mapIndex);

    internal void ReversePath() => _instancePath.Reverse();

    private static int[] EnsureLength(ref int[] buffer, int length)
    {
        if (buffer.Length < length)
        {
            Array.Resize(ref buffer, length);
        }

        return buffer;
    }
}
