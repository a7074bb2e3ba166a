using System.Runtime.InteropServices;

namespace FractalEngine.Core.Collision;

/// <summary>
/// What a query cost, and which instance it found. The caller makes one, passes it to as many queries as it likes, one thread at a time,
/// and reads it in between: there are no counters that anybody else could see.
/// </summary>
public sealed class QueryRecord
{
    private readonly List<int> _path = new(64);
    private readonly List<int> _keptPath = new(64);
    private int[] _trail = [];
    private int[] _bestTrail = [];
    private double[] _scratch = [];
    private double[] _objectBounds = [];
    private OpenCopies? _openCopies;
    private DescentBeam? _beam;

    /// <summary>How many faces were looked at: the paper's collision cost (§5.2.3). Added up until <see cref="Reset"/>.</summary>
    public long FaceTests { get; set; }

    /// <summary>How many bounding volumes were looked at. Added up until <see cref="Reset"/>.</summary>
    public long BoundTests { get; set; }

    /// <summary>
    /// The instance that the last query found: for each level, the outermost first, the number of the transformation in its set. Empty for a
    /// mesh. Shorter than the fractal's depth where deeper levels are below the precision of the answer.
    /// </summary>
    public ReadOnlySpan<int> InstancePath => CollectionsMarshal.AsSpan(_path);

    /// <summary>Sets the counters to zero.</summary>
    public void Reset() => (FaceTests, BoundTests) = (0, 0);

    /// <summary>Room for the way of a search; kept for the next one, and what is there stays.</summary>
    internal Span<int> Trail(int length) => Grown(ref _trail, length);

    /// <summary>Room for the way to the best so far.</summary>
    internal Span<int> BestTrail(int length) => Grown(ref _bestTrail, length);

    /// <summary>Of searches that take long; made by the first.</summary>
    internal OpenCopies OpenCopies => _openCopies ??= new();

    /// <summary>Of descents in several copies; made by the first.</summary>
    internal DescentBeam Beam => _beam ??= new();

    /// <summary>Room for numbers of a search; kept for the next one.</summary>
    internal Span<double> Scratch(int length) => _scratch.Length >= length ? _scratch : _scratch = new double[length];

    /// <summary>Room for a bound of each object of a scene.</summary>
    internal Span<double> ObjectBounds(int count)
    {
        if (_objectBounds.Length < count)
        {
            _objectBounds = new double[count];
        }

        return _objectBounds.AsSpan(0, count);
    }

    /// <summary>Keeps the present path while other objects are asked.</summary>
    internal void KeepPath()
    {
        _keptPath.Clear();
        _keptPath.AddRange(InstancePath);
    }

    /// <summary>Makes the path that was kept the present one again.</summary>
    internal void RestorePath()
    {
        _path.Clear();
        _path.AddRange(CollectionsMarshal.AsSpan(_keptPath));
        _keptPath.Clear();
    }

    internal void ClearPath() => _path.Clear();

    internal void AppendToPath(int number) => _path.Add(number);

    internal void ReversePath() => _path.Reverse();

    private static int[] Grown(ref int[] numbers, int length)
    {
        if (numbers.Length < length)
        {
            Array.Resize(ref numbers, length);
        }

        return numbers;
    }
}
