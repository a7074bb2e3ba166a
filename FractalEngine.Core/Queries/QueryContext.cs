using System.Runtime.InteropServices;
using FractalEngine.Core.Bvh.Objects;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Fractals.Levels.Rays;

namespace FractalEngine.Core.Queries;

/// <summary>
/// What a caller lends to queries: counts of their work, the instance that the last one found, and memory that is kept for the next. One
/// thread uses a context at a time, for any number of queries to any colliders.
/// </summary>
/// <remarks>Its first queries make its memory, some 20 KB. It doubles where one goes deeper into a fractal than all before.</remarks>
public sealed class QueryContext
{
    /// <summary>
    /// Child instances of a search on the stack, of which each takes about 1 KB. Searches that need more are left to a best-first search.
    /// </summary>
    internal const int MaxStackDepth = 128;

    /// <summary>Numbers of a search that suffice for some forty levels.</summary>
    internal const int InitialScratchLength = 2048;

    /// <summary>The largest number of objects of a scene that is searched without a hierarchy.</summary>
    /// <remarks>From about a hundred on a hierarchy is faster.</remarks>
    internal const int MaxListedObjects = 64;

    private readonly List<int> _instancePath = new(64);
    private readonly List<int> _savedPath = new(64);
    private int[] _pathBuffer = [];
    private int[] _bestPathBuffer = [];
    private FractalHierarchy? _pathHierarchy;
    private LevelState _pathStart;
    private int _unnamedLength = -1;
    private int _savedMeshIndex;
    private double[] _scratch = [];
    private double[] _objectBounds = [];
    private ExpandedChildren? _expandedChildren;
    private DescentBeam? _descentBeam;
    private ObjectQueue? _objectQueue;
    private RayStack? _rayStack;
    private TraversalStack? _traversalStack;
    private List<int>? _lightPath;

    /// <summary>Counts of faces and bounding volumes that the queries of this context tested.</summary>
    public QueryStatistics Statistics { get; } = new();

    /// <summary>
    /// The instance that the last query found: for each level, the outermost first, the index of the transformation in its set. Empty for
    /// a mesh. Shorter than the fractal's depth where deeper levels are below the precision of the result, or below identities without end.
    /// </summary>
    public ReadOnlySpan<int> InstancePath
    {
        get
        {
            if (_unnamedLength >= 0)
            {
                var path = _bestPathBuffer.AsSpan(0, _unnamedLength);
                _unnamedLength = -1;
                InstanceResolver.AppendPath(_pathHierarchy!, path, _pathStart, this);
            }

            return CollectionsMarshal.AsSpan(_instancePath);
        }
    }

    /// <summary>
    /// Index of the object that the last query found in its scene, or in a deep zoom of the sub-fractal; 0 where a single shape was
    /// queried, −1 where nothing was found.
    /// </summary>
    public int ObjectIndex { get; internal set; }

    /// <summary>
    /// Index of the base mesh that the last query found among those of the fractal; 0 where there is only one, or a collider has expanded
    /// the fractal.
    /// </summary>
    public int MeshIndex { get; internal set; }

    /// <summary>Memory for the path of a search. It is kept for the next search with its contents.</summary>
    internal Span<int> PathBuffer(int length) => EnsureLength(ref _pathBuffer, length);

    /// <summary>Memory for the path to the best result so far.</summary>
    internal Span<int> BestPathBuffer(int length) => EnsureLength(ref _bestPathBuffer, length);

    /// <summary>The queue of best-first searches, made by the first of them.</summary>
    internal ExpandedChildren ExpandedChildren => _expandedChildren ??= new();

    /// <summary>The beam of descents into several children, made by the first of them.</summary>
    internal DescentBeam DescentBeam => _descentBeam ??= new();

    /// <summary>The queue of searches among many objects, made by the first of them.</summary>
    internal ObjectQueue ObjectQueue => _objectQueue ??= new();

    /// <summary>The sub-fractals that a ray is inside of, made by the first ray.</summary>
    internal RayStack RayStack => _rayStack ??= new();

    /// <summary>The nodes that a traversal has yet to visit, made by the first of them.</summary>
    internal TraversalStack TraversalStack => _traversalStack ??= new();

    /// <summary>Indices of child instances to the emissive face that was chosen last, made by the first choice.</summary>
    internal List<int> LightPath => _lightPath ??= [];

    /// <summary>Length of the path to what the last ray has hit in the buffer of the best path; −1 where that is a proxy.</summary>
    internal int ChildPathLength { get; set; }

    /// <summary>Indices of child instances to what the last ray has hit.</summary>
    internal ReadOnlySpan<int> ChildPath => _bestPathBuffer.AsSpan(0, Math.Max(0, ChildPathLength));

    /// <summary>Memory for the numbers of a search, kept for the next search.</summary>
    internal Span<double> ScratchBuffer(int length) => _scratch.Length >= length ? _scratch : _scratch = new double[length];

    /// <summary>Memory for a lower bound of each of a few objects.</summary>
    internal Span<double> ObjectBoundsBuffer(int count)
    {
        if (_objectBounds.Length < count)
        {
            _objectBounds = new double[count];
        }

        return _objectBounds.AsSpan(0, count);
    }

    /// <summary>Saves the present instance while other objects are queried.</summary>
    internal void SaveInstance()
    {
        _savedPath.Clear();
        _savedPath.AddRange(InstancePath);
        _savedMeshIndex = MeshIndex;
    }

    /// <summary>Restores the instance that was saved last.</summary>
    internal void RestoreInstance()
    {
        ClearPath();
        _instancePath.AddRange(CollectionsMarshal.AsSpan(_savedPath));
        MeshIndex = _savedMeshIndex;
    }

    /// <summary>Makes the memory of most searches before the first of them.</summary>
    internal void MakeRoom()
    {
        PathBuffer(MaxStackDepth);
        BestPathBuffer(MaxStackDepth);
        ScratchBuffer(InitialScratchLength);
        ObjectBoundsBuffer(MaxListedObjects);
        _traversalStack ??= new();
        _objectQueue ??= new();
    }

    /// <summary>Sets the instance that was found. Few ask for its path, so that it is named only then.</summary>
    /// <param name="hierarchy">The levels of the fractal.</param>
    /// <param name="start">Where the sub-fractal is that the path begins at.</param>
    /// <param name="pathLength">Number of child instances on the path, which begin the buffer of the best path.</param>
    /// <param name="meshIndex">Index of its base mesh.</param>
    internal void SetInstance(FractalHierarchy hierarchy, LevelState start, int pathLength, int meshIndex)
    {
        // Often that of the last query, and to write a reference costs more than to compare it.
        if (_pathHierarchy != hierarchy)
        {
            _pathHierarchy = hierarchy;
        }

        _pathStart = start;
        _unnamedLength = pathLength;
        MeshIndex = meshIndex;
    }

    internal void ClearPath()
    {
        _instancePath.Clear();
        _unnamedLength = -1;
        MeshIndex = 0;
        ChildPathLength = 0;
    }

    internal void ShortenPath(int length) => CollectionsMarshal.SetCount(_instancePath, length);

    internal void AppendToPath(int mapIndex) => _instancePath.Add(mapIndex);

    internal void ReversePath() => _instancePath.Reverse();

    private static int[] EnsureLength(ref int[] buffer, int length)
    {
        if (buffer.Length < length)
        {
            Array.Resize(ref buffer, Math.Max(length, 2 * buffer.Length));
        }

        return buffer;
    }
}
