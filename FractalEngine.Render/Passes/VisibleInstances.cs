using FractalEngine.Core.Visibility;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Preparation;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Passes;

/// <summary>
/// The instances of one object that were chosen for a picture, on the GPU: a vertex array of their own over the buffers of the model.
/// </summary>
internal sealed class VisibleInstances : IDisposable
{
    private const int TintLocation = 5;

    private readonly GlBuffer _instances;
    private readonly GlBuffer? _tints;
    private readonly VertexArray _vertexArray;
    private int _instanceCount;

    /// <summary>None yet.</summary>
    public VisibleInstances(GlResources resources, string name, ModelBuffers model, bool hasTints)
    {
        _instances = new(resources, $"chosen instances of {name}", BufferTarget.ArrayBuffer);
        _vertexArray = new(resources, $"chosen instances of {name}");
        model.Attach(_vertexArray, _instances);
        if (hasTints)
        {
            _tints = new(resources, $"tints of {name}", BufferTarget.ArrayBuffer);
            _vertexArray.Attribute(_tints, TintLocation, 1, 1, 0, divisor: 1);
            _vertexArray.Unbind();
        }
    }

    /// <summary>Bytes that uploads have moved so far.</summary>
    public long UploadedBytes { get; private set; }

    /// <summary>Replaces them.</summary>
    /// <param name="visible">What was chosen.</param>
    /// <param name="objectIndex">The object's place there.</param>
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

    /// <summary>Draws the triangles of one material of all instances in one call.</summary>
    public void Draw(DrawableBatch batch)
    {
        if (_instanceCount > 0 && batch.IndexCount > 0)
        {
            _vertexArray.Bind();
            GL.DrawElementsInstanced(
                PrimitiveType.Triangles, batch.IndexCount, DrawElementsType.UnsignedInt, (nint)batch.FirstIndex * sizeof(uint),
                _instanceCount);
        }
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        _vertexArray.Dispose();
        _tints?.Dispose();
        _instances.Dispose();
    }
}
