using System.Collections.Immutable;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Wavefront;

/// <summary>What an OBJ file has declared so far, in the order of its lines.</summary>
internal sealed class ObjContents
{
    private readonly List<MeshBlock> _blocks = [];
    private readonly List<string> _materialLibraries = [];
    private readonly List<SourcePosition> _libraryPositions = [];
    private readonly HashSet<string> _knownLibraries = [];
    private readonly Dictionary<string, SourcePosition> _materialPositions = [];

    /// <summary>Lines with unknown keywords.</summary>
    public RepeatedWarning UnknownLines { get; } = new("lines with unknown keywords");

    /// <summary>Indices of normals or texture coordinates that don't exist.</summary>
    public RepeatedWarning InvalidIndices { get; } = new("such corners");

    /// <summary>Faces with fewer than three corners, which are skipped.</summary>
    public RepeatedWarning ShortFaces { get; } = new("such faces");

    /// <summary>Numbers of elements in all blocks so far.</summary>
    public ElementCounts Counts { get; private set; }

    /// <summary>Names and materials of faces.</summary>
    public MeshGroupList Groups { get; } = new();

    /// <summary>Whether there is a vertex, face, group or material.</summary>
    public bool HasDeclaration { get; set; }

    /// <summary>Adds elements behind all others.</summary>
    public void Add(MeshBlock block)
    {
        block.Before = Counts;
        _blocks.Add(block);
        Counts += block.Counts;
    }

    /// <summary>Records the use of a material, whose first position counts.</summary>
    public void AddMaterial(string name, SourcePosition position) => _materialPositions.TryAdd(name, position);

    /// <summary>Adds a material file, unless its name is empty or was added before.</summary>
    public void AddMaterialLibrary(string file, SourcePosition position)
    {
        if (file.Length > 0 && _knownLibraries.Add(file))
        {
            _materialLibraries.Add(file);
            _libraryPositions.Add(position);
        }
    }

    /// <summary>Creates the mesh of all that was added.</summary>
    /// <param name="threadCount">Number of threads that merge the blocks, at least one.</param>
    /// <param name="byteCount">Size of the file in bytes.</param>
    public ParsedObj Complete(int threadCount, long byteCount) =>
        new(MeshAssembler.Assemble(_blocks, Counts, threadCount).WithGroups(Groups.Complete(Counts.Faces), [.. _materialLibraries]),
            CreateWarnings())
        {
            MaterialLibraryPositions = [.. _libraryPositions],
            MaterialPositions = _materialPositions,
            ByteCount = byteCount,
        };

    private ImmutableArray<Diagnostic> CreateWarnings() =>
        [.. new[] { UnknownLines, InvalidIndices, ShortFaces }.Select(static warning => warning.ToDiagnostic()).OfType<Diagnostic>()];
}
