using FractalEngine.Core.Visibility;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Preparation;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Passes;

/// <summary>Holds the visible instances of one object on the GPU, in a vertex array of their own over the model's buffers.</summary>
internal sealed class VisibleInstances : IDisposable
{
    private const int TintLocation = 5;

    private readonly GlBuffer _instances;
    private readonly GlBuffer? _tints;
    private readonly VertexArray _vertexArray;
    private int _instanceCount;

    /// <summary>Creates empty buffers for visible instances.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="name">Name of the object, for messages.</param>
    /// <param name="model">Buffers of the object's model.</param>
    /// <param name="hasTints">Whether the object has a gradient, so that each instance has a position in it.</param>
    public VisibleInstances(GlResources resources, string name, ModelBuffers model, bool hasTints)
    {
        _instances = new(resources, $"visible instances of {name}", BufferTarget.ArrayBuffer);
        _vertexArray = new(resources, $"visible instances of {name}");
        model.Attach(_vertexArray, _instances);
        if (hasTints)
        {
            _tints = new(resources, $"tints of {name}", BufferTarget.ArrayBuffer);
            _vertexArray.Attribute(_tints, TintLocation, 1, 1, 0, divisor: 1);
            _vertexArray.Unbind();
        }
    }

    /// <summary>Bytes that were uploaded so far.</summary>
    public long UploadedBytes { get; private set; }

    /// <summary>Replaces the instances on the GPU.</summary>
    /// <param name="visible">Visible instances of all objects.</param>
    /// <param name="objectIndex">Index of the object in that set.</param>
    public void Upload(VisibleSet visible, int objectIndex)
    {
        _instanceCount = visible.InstanceCountOf(objectIndex);
        _instances.Discard(_instanceCount * VisibleSet.FloatsPerInstance * sizeof(float));
        var offset = 0;
        for (var chunk = 0; chunk < VisibleSet.ChunkCount; chunk++)
        {
            offset += _instances.Write(visible.Instances(objectIndex, chunk), offset);
        }

        UploadedBytes += offset;
        if (_tints is null)
        {
            return;
        }

        _tints.Discard(_instanceCount * sizeof(float));
        offset = 0;
        for (var chunk = 0; chunk < VisibleSet.ChunkCount; chunk++)
        {
            offset += _tints.Write(visible.GradientFactors(objectIndex, chunk), offset);
        }

        UploadedBytes += offset;
    }

    /// <summary>Draws one batch of all instances in one call.</summary>
    public void Draw(DrawableBatch batch) => _vertexArray.DrawTriangles(batch.FirstIndex, batch.IndexCount, _instanceCount);

    /// <inheritdoc/>
    public void Dispose()
    {
        _vertexArray.Dispose();
        _tints?.Dispose();
        _instances.Dispose();
    }
}
