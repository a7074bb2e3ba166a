using System.Globalization;
using System.Text;
using System.Text.Json.Nodes;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Exports.Gltf;

/// <summary>A glTF file while it is described: its JSON, and what writes the numbers behind it.</summary>
/// <remarks>Numbers are written when the file is, so that instances are never held in memory.</remarks>
internal sealed class GltfDocument
{
    private const int HeaderLength = 12;
    private const int ChunkHeaderLength = 8;
    private const int Alignment = 4;
    private const int MaxPiece = 512;

    private readonly List<(long Length, Action<LittleEndianWriter> Write)> _views = [];
    private readonly SortedSet<string> _extensions = new(StringComparer.Ordinal);
    private readonly JsonObject _root = new()
    {
        ["asset"] = new JsonObject { ["version"] = "2.0", ["generator"] = "FractalEngine" },
    };

    private long _length;

    /// <summary>Returns one of the arrays of the file, by its name.</summary>
    public JsonArray this[string name] => (JsonArray)(_root[name] ??= new JsonArray());

    /// <summary>Adds an item to one of the arrays.</summary>
    /// <returns>Its index.</returns>
    public int Add(string array, JsonObject item)
    {
        this[array].Add((JsonNode)item);
        return this[array].Count - 1;
    }

    /// <summary>Adds a node, which the only scene of the file shows.</summary>
    /// <param name="node">The node.</param>
    /// <param name="property">One more property of it, by its name.</param>
    public void AddNode(JsonObject node, (string Name, int Value)? property = null)
    {
        if (property is { } added)
        {
            node[added.Name] = added.Value;
        }

        if (this["scenes"].Count == 0)
        {
            Add("scenes", new() { ["nodes"] = new JsonArray() });
            _root["scene"] = 0;
        }

        this["scenes"][0]!["nodes"]!.AsArray().Add((JsonNode)Add("nodes", node));
    }

    /// <summary>Returns an array that an extension keeps for the whole file.</summary>
    public JsonArray ExtensionArray(string extension, string name)
    {
        var extensions = (JsonObject)(_root["extensions"] ??= new JsonObject());
        var ofExtension = (JsonObject)(extensions[extension] ??= new JsonObject());
        return (JsonArray)(ofExtension[name] ??= new JsonArray());
    }

    /// <summary>Declares an extension that the file uses.</summary>
    /// <param name="name">Name of the extension.</param>
    /// <param name="isRequired">Whether programs that don't know it can't show the file.</param>
    public void Use(string name, bool isRequired = false)
    {
        if (_extensions.Add(name))
        {
            this["extensionsUsed"].Add((JsonNode)name);
            if (isRequired)
            {
                this["extensionsRequired"].Add((JsonNode)name);
            }
        }
    }

    /// <summary>Adds an accessor, and the numbers that it reads.</summary>
    /// <param name="type">SCALAR for whole numbers of 32 bits; VEC2, VEC3 or VEC4 for floats.</param>
    /// <param name="count">Number of scalars or vectors.</param>
    /// <param name="write">Writes them.</param>
    /// <param name="target">34962 for vertices, 34963 for indices, 0 for others.</param>
    /// <returns>Index of the accessor.</returns>
    public int AddNumbers(string type, long count, Action<LittleEndianWriter> write, int target = 0)
    {
        var components = type == "SCALAR" ? 1 : type[^1] - '0';
        return Add("accessors", new()
        {
            ["bufferView"] = AddView(count * components * sizeof(float), write, target),
            ["componentType"] = type == "SCALAR" ? 5125 : 5126,
            ["count"] = count,
            ["type"] = type,
        });
    }

    /// <summary>Adds the bytes of an image, as they are.</summary>
    /// <returns>Index of its view.</returns>
    public int AddBytes(byte[] bytes) => AddView(bytes.Length, writer =>
    {
        for (var i = 0; i < bytes.Length; i += MaxPiece)
        {
            writer.WriteBytes(bytes.AsSpan(i, Math.Min(MaxPiece, bytes.Length - i)));
        }
    });

    /// <summary>The sixteen numbers of a map, by columns.</summary>
    /// <exception cref="Core.FractalEngineException">One of them is beyond the range of a float.</exception>
    public static JsonArray MatrixOf(AffineMap map) =>
    [
        .. new[] { map.Linear.V1, map.Linear.V2, map.Linear.V3, map.Translation }.SelectMany(static (column, index) =>
        {
            var (x, y, z) = LittleEndianWriter.RequireSingle(column);
            return new JsonNode[] { x, y, z, index == 3 ? 1 : 0 };
        }),
    ];

    /// <summary>Writes the JSON, and then all numbers and images.</summary>
    /// <param name="stream">Receives the file.</param>
    /// <param name="progress">Told the part that is written; null for nobody.</param>
    /// <exception cref="FractalLimitException">It has more bytes than its format can count. Nothing is written then.</exception>
    public void Write(Stream stream, IProgress<double>? progress)
    {
        if (_length > 0)
        {
            Add("buffers", new() { ["byteLength"] = _length });
        }

        var json = Encoding.UTF8.GetBytes(_root.ToJsonString());
        var jsonLength = Align(json.Length);
        var total = HeaderLength + ChunkHeaderLength + jsonLength + (_length > 0 ? ChunkHeaderLength + _length : 0);
        if (total > uint.MaxValue)
        {
            throw new FractalLimitException(string.Create(
                CultureInfo.InvariantCulture, $"the file would have {total} bytes, more than a .glb can count: {uint.MaxValue}"));
        }

        var writer = new LittleEndianWriter(stream, progress, total - json.Length);
        writer.WriteBytes("glTF"u8);
        writer.WriteUInt32(2);
        writer.WriteUInt32((uint)total);
        writer.WriteUInt32((uint)jsonLength);
        writer.WriteBytes("JSON"u8);
        writer.Flush();
        stream.Write(json);
        Pad(writer, json.Length, (byte)' ');
        if (_length > 0)
        {
            writer.WriteUInt32((uint)_length);
            writer.WriteBytes("BIN\0"u8);
        }

        foreach (var (length, write) in _views)
        {
            write(writer);
            Pad(writer, length, 0);
        }

        writer.Flush();
    }

    private int AddView(long length, Action<LittleEndianWriter> write, int target = 0)
    {
        var view = new JsonObject { ["buffer"] = 0, ["byteOffset"] = _length, ["byteLength"] = length };
        if (target != 0)
        {
            view["target"] = target;
        }

        _views.Add((length, write));
        _length += Align(length);
        return Add("bufferViews", view);
    }

    private static long Align(long length) => (length + Alignment - 1) / Alignment * Alignment;

    private static void Pad(LittleEndianWriter writer, long length, byte padding)
    {
        for (var i = length; i < Align(length); i++)
        {
            writer.WriteBytes([padding]);
        }
    }
}
