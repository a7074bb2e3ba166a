using FractalEngine.Render.Gl.State;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>A GL buffer object with one binding target.</summary>
internal sealed class GlBuffer : GlObject
{
    private readonly BufferTarget _target;
    private readonly int _name;
    private nint _size;

    /// <summary>Creates an empty buffer.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="label">Name of the buffer, for messages.</param>
    /// <param name="target">Target that the buffer is bound to.</param>
    public GlBuffer(GlResources resources, string label, BufferTarget target)
        : base(resources, label)
    {
        _target = target;
        _name = GL.GenBuffer();
    }

    /// <summary>Binds the buffer to its target.</summary>
    public void Bind() => GL.BindBuffer(_target, _name);

    /// <summary>Binds a uniform buffer to a binding point.</summary>
    public void BindTo(int bindingPoint) => Resources.State.BindUniformBuffer(bindingPoint, _name);

    /// <summary>Replaces the contents. Storage is allocated only when the size changes.</summary>
    /// <param name="data">New contents.</param>
    /// <param name="usage">Hint to the driver on how often the contents change.</param>
    /// <exception cref="GlException">The memory does not suffice.</exception>
    public void Upload<T>(ReadOnlySpan<T> data, BufferUsageHint usage)
        where T : unmanaged
    {
        Bind();
        unsafe
        {
            var size = checked((nint)data.Length * sizeof(T));
            fixed (T* start = data)
            {
                if (size != _size)
                {
                    GL.BufferData(_target, size, (nint)start, usage);
                    _size = size;
                    Resources.ThrowOnError($"{this} of {size} bytes");
                }
                else if (size > 0)
                {
                    GL.BufferSubData(_target, IntPtr.Zero, size, (nint)start);
                }
            }
        }
    }

    /// <summary>Makes room for new contents. A driver that still draws the old ones keeps them until it is done.</summary>
    /// <param name="bytes">Bytes that will be written. Where the storage is replaced, it becomes half larger than this.</param>
    /// <exception cref="GlException">The memory does not suffice.</exception>
    public void Discard(long bytes)
    {
        Bind();
        // Growing for each frame would be slow, and so is discarding a buffer that is far too large.
        if (bytes > _size || bytes < _size / 4)
        {
            _size = checked((nint)(bytes + (bytes / 2)));
        }

        GL.BufferData(_target, _size, IntPtr.Zero, BufferUsageHint.StreamDraw);
        Resources.ThrowOnError($"{this} of {_size} bytes");
    }

    /// <summary>Overwrites a part of the contents.</summary>
    /// <param name="data">Floats to write.</param>
    /// <param name="offset">Position of the first float, bytes from the start of the buffer.</param>
    /// <returns>Number of bytes that were written.</returns>
    public long Write(ReadOnlySpan<float> data, long offset)
    {
        Bind();
        unsafe
        {
            fixed (float* start = data)
            {
                if (data.Length > 0)
                {
                    GL.BufferSubData(_target, checked((nint)offset), (nint)data.Length * sizeof(float), (nint)start);
                }
            }
        }

        return (long)data.Length * sizeof(float);
    }

    /// <inheritdoc/>
    protected internal override void Delete() => Resources.State.DeleteBuffer(_name);
}
