using FractalEngine.Core.Detail;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Preparation;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Passes;

/// <summary>The instances of one object that were chosen for a picture, on the GPU: a vertex array of their own over the buffers of the model.</summary>
internal sealed class ChosenInstances : IDisposable
{
    private const int TintLocation = 5;

    private readonly GlBuffer _instances;
    private readonly GlBuffer? _tints;
    private readonly VertexArray _array;
    private int _count;

    /// <summary>None yet.</summary>
    public ChosenInstances(GlResources resources, string name, ModelBuffers model, bool hasTints)
    {
        _instances = new(resources, $"chosen instances of {name}", BufferTarget.ArrayBuffer);
        _array = new(resources, $"chosen instances of {name}");
        model.Attach(_array, _instances);
        if (hasTints)
        {
            _tints = new(resources, $"tints of {name}", BufferTarget.ArrayBuffer);
            _array.Attribute(_tints, TintLocation, 1, 1, 0, divisor: 1);
            _array.Unbind();
        }
    }

    /// <summary>Bytes that uploads have moved so far.</summary>
    public long UploadedBytes { get; private set; }

    /// <summary>Replaces them.</summary>
    /// <param name="chosen">What was chosen.</param>
    /// <param name="item">The object's place there.</param>
    public void Upload(VisibleSet chosen, int item)
    {
        _count = chosen.CountOf(item);
        _instances.Discard(_count * VisibleSet.InstanceFloats * sizeof(float));
        var offset = 0;
        for (var part = 0; part < VisibleSet.PartCount; part++)
        {
            offset += _instances.Write(chosen.Part(item, part), offset);
        }

        UploadedBytes += offset;
        if (_tints is null)
        {
            return;
        }

        _tints.Discard(_count * sizeof(float));
        offset = 0;
        for (var part = 0; part < VisibleSet.PartCount; part++)
        {
            offset += _tints.Write(chosen.Tints(item, part), offset);
        }

        UploadedBytes += offset;
    }

    /// <summary>Draws the triangles of one material of all instances in one call.</summary>
    public void Draw(DrawableBatch batch)
    {
        if (_count > 0 && batch.IndexCount > 0)
        {
            _array.Bind();
            GL.DrawElementsInstanced(
                PrimitiveType.Triangles, batch.IndexCount, DrawElementsType.UnsignedInt, (nint)batch.FirstIndex * sizeof(uint), _count);
        }
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        _array.Dispose();
        _tints?.Dispose();
        _instances.Dispose();
    }
}
