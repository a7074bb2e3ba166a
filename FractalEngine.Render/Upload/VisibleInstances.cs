using FractalEngine.Core.Visibility;
using FractalEngine.Render.Drawables;
using FractalEngine.Render.Gl;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Upload;

/// <summary>
/// Holds the visible instances of one object on the GPU, in a vertex array of their own over the model's buffers. One instance, such as
/// that of a mesh, needs neither array nor buffer: its map is set before each draw.
/// </summary>
internal sealed class VisibleInstances : IDisposable
{
    private const int TintLocation = 5;
    private const int PaletteColourLocation = 11;
    private const int CoveredSidesLocation = 12;
    private const int SkyAboveLocation = 8;
    private const int SkyBelowLocation = 9;

    private readonly List<(GlBuffer Buffer, int FloatsPerInstance, ChunkReader ChunkOf)> _buffers = [];
    private readonly VertexArray _vertexArray;
    private readonly GlBuffer? _skyParts;
    private readonly float[] _map = [];
    private int _instanceCount;

    /// <summary>Creates empty buffers for visible instances.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="name">Name of the object, for messages.</param>
    /// <param name="model">Buffers of the object's model.</param>
    /// <param name="isSingle">Whether there is at most one instance, without position in a gradient and without parts of the sky.</param>
    /// <param name="hasTints">Whether the object has a gradient, so that each instance has a position in it.</param>
    /// <param name="hasSkyParts">Whether instances come with the parts of the sky that they see.</param>
    /// <param name="hasMapTints">Whether instances come with what maps mix into their colours.</param>
    /// <param name="hasPalette">Whether instances come with colours of a palette.</param>
    /// <param name="hasCoveredSides">Whether instances come with the sides that are never seen.</param>
    public VisibleInstances(
        GlResources resources, string name, ModelBuffers model, bool isSingle, bool hasTints, bool hasSkyParts, bool hasMapTints,
        bool hasPalette, bool hasCoveredSides)
    {
        if (isSingle)
        {
            _vertexArray = model.MeshAlone;
            _map = new float[VisibleSet.FloatsPerInstance];
            return;
        }

        _vertexArray = new(resources, $"visible instances of {name}");
        model.Attach(
            _vertexArray, Add("visible instances", VisibleSet.FloatsPerInstance, static (set, i, chunk) => set.Instances(i, chunk)));
        AddIf(hasTints, "tints", 1, static (set, i, chunk) => set.GradientFactors(i, chunk), TintLocation);
        AddIf(hasMapTints, "colours of maps", 4, static (set, i, chunk) => set.Tints(i, chunk), ModelBuffers.MapTintLocation);
        AddIf(hasPalette, "palette colours", 4, static (set, i, chunk) => set.PaletteColours(i, chunk), PaletteColourLocation);
        AddIf(hasCoveredSides, "covered sides", 1, static (set, i, chunk) => set.CoveredSides(i, chunk), CoveredSidesLocation);
        _skyParts = AddIf(hasSkyParts, "sky", 6, static (set, i, chunk) => set.SkyParts(i, chunk), SkyAboveLocation, SkyBelowLocation);
        _vertexArray.Unbind();

        GlBuffer Add(string contents, int floatsPerInstance, ChunkReader chunkOf)
        {
            var buffer = new GlBuffer(resources, $"{contents} of {name}", BufferTarget.ArrayBuffer);
            _buffers.Add((buffer, floatsPerInstance, chunkOf));
            return buffer;
        }

        GlBuffer? AddIf(bool isThere, string contents, int floatsPerInstance, ChunkReader chunkOf, params ReadOnlySpan<int> locations)
        {
            var buffer = isThere ? Add(contents, floatsPerInstance, chunkOf) : null;
            var components = floatsPerInstance / locations.Length;
            for (var i = 0; i < locations.Length && buffer is not null; i++)
            {
                _vertexArray.Attribute(buffer, locations[i], components, floatsPerInstance, i * components, divisor: 1);
            }

            return buffer;
        }
    }

    private delegate ReadOnlySpan<float> ChunkReader(VisibleSet visible, int objectIndex, int chunk);

    /// <summary>Bytes that were uploaded so far.</summary>
    public long UploadedBytes { get; private set; }

    /// <summary>Replaces the instances on the GPU.</summary>
    /// <param name="visible">Visible instances of all objects.</param>
    /// <param name="objectIndex">Index of the object in that set.</param>
    /// <param name="hasSkyParts">Whether the set has parts of the sky.</param>
    public void Upload(VisibleSet visible, int objectIndex, bool hasSkyParts)
    {
        _instanceCount = visible.InstanceCountOf(objectIndex);
        if (_map.Length > 0)
        {
            CopyMap(visible, objectIndex);
            return;
        }

        foreach (var (buffer, floatsPerInstance, chunkOf) in _buffers)
        {
            if (buffer == _skyParts && !hasSkyParts)
            {
                continue;
            }

            buffer.Discard((long)_instanceCount * floatsPerInstance * sizeof(float));
            var offset = 0L;
            for (var chunk = 0; chunk < VisibleSet.ChunkCount; chunk++)
            {
                offset += buffer.Write(chunkOf(visible, objectIndex, chunk), offset);
            }

            UploadedBytes += offset;
        }
    }

    /// <summary>Draws one batch of all instances in one call.</summary>
    public void Draw(DrawableBatch batch)
    {
        for (var row = 0; row < 3 && _map.Length > 0 && _instanceCount > 0; row++)
        {
            VertexArray.SetConstant(ModelBuffers.InstanceRowsLocation + row, _map.AsSpan(4 * row, 4));
        }

        _vertexArray.DrawTriangles(batch.FirstIndex, batch.IndexCount, _instanceCount);
    }

    /// <inheritdoc/>
    public void Dispose() =>
        GlObject.DisposeAll([_map.Length > 0 ? null : _vertexArray, .. _buffers.Select(static one => one.Buffer)]);

    private void CopyMap(VisibleSet visible, int objectIndex)
    {
        for (var chunk = 0; chunk < VisibleSet.ChunkCount && _instanceCount > 0; chunk++)
        {
            var instances = visible.Instances(objectIndex, chunk);
            if (instances.Length > 0)
            {
                instances.CopyTo(_map);
                UploadedBytes += sizeof(float) * _map.Length;
                return;
            }
        }
    }
}
