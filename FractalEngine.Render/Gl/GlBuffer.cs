using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>A buffer object.</summary>
internal sealed class GlBuffer : GlObject
{
    private readonly BufferTarget _target;
    private readonly int _name;
    private nint _size;

    /// <summary>An empty buffer.</summary>
    public GlBuffer(GlResources resources, string label, BufferTarget target)
        : base(resources, label) => (_target, _name) = (target, GL.GenBuffer());

    /// <summary>Binds the buffer to its target.</summary>
    public void Bind() => GL.BindBuffer(_target, _name);

    /// <summary>Binds a uniform buffer to a binding point.</summary>
    public void BindTo(int bindingPoint) => Resources.State.BindUniformBuffer(bindingPoint, _name);

    /// <summary>Replaces the contents; storage is allocated only when the size changes.</summary>
    /// <param name="data">Plain data.</param>
    /// <param name="usage">How often it changes.</param>
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

    /// <summary>Makes room for new contents; a driver that still draws the old ones keeps them. Half more than is needed is kept.</summary>
    /// <param name="bytes">That will be written.</param>
    /// <exception cref="GlException">The memory does not suffice.</exception>
    public void Discard(int bytes)
    {
        Bind();
        // Neither grown at every picture, nor kept large: to discard a large buffer takes time.
        if (bytes > _size || bytes < _size / 4)
        {
            _size = bytes + (bytes / 2);
        }

        GL.BufferData(_target, _size, IntPtr.Zero, BufferUsageHint.StreamDraw);
        Resources.ThrowOnError($"{this} of {_size} bytes");
    }

    /// <summary>Writes a part.</summary>
    /// <param name="data">Floats.</param>
    /// <param name="offset">Bytes before it.</param>
    /// <returns>Its length in bytes.</returns>
    public int Write(ReadOnlySpan<float> data, int offset)
    {
        Bind();
        unsafe
        {
            fixed (float* start = data)
            {
                if (data.Length > 0)
                {
                    GL.BufferSubData(_target, offset, data.Length * sizeof(float), (nint)start);
                }
            }
        }

        return data.Length * sizeof(float);
    }

    /// <inheritdoc/>
    protected override void Delete() => Resources.State.DeleteBuffer(_name);
}
