using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>A vertex array object: which buffers feed which attributes.</summary>
internal sealed class VertexArray : GlObject
{
    private readonly int _name;

    /// <summary>Without attributes.</summary>
    public VertexArray(GlResources resources, string label)
        : base(resources, label) => _name = GL.GenVertexArray();

    /// <summary>Makes this the current vertex array.</summary>
    public void Bind() => Resources.State.BindVertexArray(_name);

    /// <summary>Leaves no vertex array bound, so that later index buffers do not land in this one.</summary>
    public void Unbind() => Resources.State.BindVertexArray(0);

    /// <summary>Feeds an attribute of floats from a buffer.</summary>
    /// <param name="source">Interleaved floats.</param>
    /// <param name="location">The attribute's location in the shader.</param>
    /// <param name="components">1 to 4.</param>
    /// <param name="stride">Floats from one element to the next.</param>
    /// <param name="offset">Floats before the first component.</param>
    /// <param name="divisor">0: one element a vertex; 1: one an instance.</param>
    public void Attribute(GlBuffer source, int location, int components, int stride, int offset, int divisor = 0)
    {
        Bind();
        source.Bind();
        GL.EnableVertexAttribArray(location);
        GL.VertexAttribPointer(
            location, components, VertexAttribPointerType.Float, false, stride * sizeof(float), (IntPtr)(offset * sizeof(float)));
        GL.VertexAttribDivisor(location, divisor);
    }

    /// <inheritdoc/>
    protected override void Delete() => Resources.State.DeleteVertexArray(_name);
}
