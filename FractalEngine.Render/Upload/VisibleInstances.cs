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

    private readonly GlBuffer? _instances;
    private readonly GlBuffer? _tints;
    private readonly GlBuffer? _skyParts;
    private readonly GlBuffer? _mapTints;
    private readonly GlBuffer? _paletteColours;
    private readonly GlBuffer? _coveredSides;
    private readonly VertexArray _vertexArray;
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

        _instances = new(resources, $"visible instances of {name}", BufferTarget.ArrayBuffer);
        _vertexArray = new(resources, $"visible instances of {name}");
        model.Attach(_vertexArray, _instances);
        if (hasTints)
        {
            _tints = new(resources, $"tints of {name}", BufferTarget.ArrayBuffer);
            _vertexArray.Attribute(_tints, TintLocation, 1, 1, 0, divisor: 1);
        }

        if (hasMapTints)
        {
            _mapTints = new(resources, $"colours of maps of {name}", BufferTarget.ArrayBuffer);
            _vertexArray.Attribute(_mapTints, ModelBuffers.MapTintLocation, 4, 4, 0, divisor: 1);
        }

        if (hasPalette)
        {
            _paletteColours = new(resources, $"palette colours of {name}", BufferTarget.ArrayBuffer);
            _vertexArray.Attribute(_paletteColours, PaletteColourLocation, 4, 4, 0, divisor: 1);
        }

        if (hasCoveredSides)
        {
            _coveredSides = new(resources, $"covered sides of {name}", BufferTarget.ArrayBuffer);
            _vertexArray.Attribute(_coveredSides, CoveredSidesLocation, 1, 1, 0, divisor: 1);
        }

        if (hasSkyParts)
        {
            _skyParts = new(resources, $"sky of {name}", BufferTarget.ArrayBuffer);
            _vertexArray.Attribute(_skyParts, SkyAboveLocation, 3, 6, 0, divisor: 1);
            _vertexArray.Attribute(_skyParts, SkyBelowLocation, 3, 6, 3, divisor: 1);
        }

        _vertexArray.Unbind();
    }

    /// <summary>Bytes that were uploaded so far.</summary>
    public long UploadedBytes { get; private set; }

    /// <summary>Replaces the instances on the GPU.</summary>
    /// <param name="visible">Visible instances of all objects.</param>
    /// <param name="objectIndex">Index of the object in that set.</param>
    /// <param name="hasSkyParts">Whether the set has parts of the sky.</param>
    public void Upload(VisibleSet visible, int objectIndex, bool hasSkyParts)
    {
        _instanceCount = visible.InstanceCountOf(objectIndex);
        if (_instances is null)
        {
            CopyMap(visible, objectIndex);
            return;
        }

        Upload(_instances, VisibleSet.FloatsPerInstance, static (set, index, chunk) => set.Instances(index, chunk));
        if (_tints is not null)
        {
            Upload(_tints, 1, static (set, index, chunk) => set.GradientFactors(index, chunk));
        }

        if (_mapTints is not null)
        {
            Upload(_mapTints, 4, static (set, index, chunk) => set.Tints(index, chunk));
        }

        if (_paletteColours is not null)
        {
            Upload(_paletteColours, 4, static (set, index, chunk) => set.PaletteColours(index, chunk));
        }

        if (_coveredSides is not null)
        {
            Upload(_coveredSides, 1, static (set, index, chunk) => set.CoveredSides(index, chunk));
        }

        if (_skyParts is not null && hasSkyParts)
        {
            Upload(_skyParts, 6, static (set, index, chunk) => set.SkyParts(index, chunk));
        }

        void Upload(GlBuffer buffer, int floatsPerInstance, Func<VisibleSet, int, int, ReadOnlySpan<float>> chunkOf)
        {
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
    public void Dispose() => GlObject.DisposeAll(
        _instances is null ? null : _vertexArray, _tints, _mapTints, _paletteColours, _coveredSides, _skyParts, _instances);

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
