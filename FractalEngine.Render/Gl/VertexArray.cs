using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>A vertex array object, which connects buffers to vertex attributes.</summary>
internal sealed class VertexArray : GlObject
{
    private readonly int _name;

    /// <summary>Creates a vertex array without attributes.</summary>
    public VertexArray(GlResources resources, string label)
        : base(resources, label) => _name = GL.GenVertexArray();

    /// <summary>Makes this the current vertex array.</summary>
    public void Bind() => Resources.State.BindVertexArray(_name);

    /// <summary>Leaves no vertex array bound, so that an index buffer bound later does not become part of this one.</summary>
    public void Unbind() => Resources.State.BindVertexArray(0);

    /// <summary>Connects an attribute of floats to a buffer.</summary>
    /// <param name="source">Buffer of interleaved floats.</param>
    /// <param name="location">Location of the attribute in the shader.</param>
    /// <param name="components">Number of components, 1 to 4.</param>
    /// <param name="stride">Floats from one element to the next.</param>
    /// <param name="offset">Floats before the first component.</param>
    /// <param name="divisor">0 for one element a vertex, 1 for one an instance.</param>
    public void Attribute(GlBuffer source, int location, int components, int stride, int offset, int divisor = 0)
    {
        Bind();
        source.Bind();
        GL.EnableVertexAttribArray(location);
        GL.VertexAttribPointer(
            location, components, VertexAttribPointerType.Float, false, stride * sizeof(float), (IntPtr)(offset * sizeof(float)));
        GL.VertexAttribDivisor(location, divisor);
    }

    /// <summary>Sets the value that an attribute has for all vertices, where no buffer is connected to it.</summary>
    /// <param name="location">Location of the attribute in the shader.</param>
    /// <param name="value">Four floats.</param>
    /// <remarks>The value belongs to the context, so that it is set before each draw.</remarks>
    public static void SetConstant(int location, ReadOnlySpan<float> value) =>
        GL.VertexAttrib4(location, value[0], value[1], value[2], value[3]);

    /// <summary>Draws indexed triangles of several instances in one call; nothing where there are no indices or no instances.</summary>
    /// <param name="firstIndex">Position of the first index in the index buffer.</param>
    /// <param name="indexCount">Number of indices, three a triangle.</param>
    /// <param name="instanceCount">Number of instances.</param>
    public void DrawTriangles(int firstIndex, int indexCount, int instanceCount)
    {
        if (indexCount > 0 && instanceCount > 0)
        {
            Bind();
            Resources.State.DrawCallCount++;
            GL.DrawElementsInstanced(
                PrimitiveType.Triangles, indexCount, DrawElementsType.UnsignedInt, (nint)firstIndex * sizeof(uint), instanceCount);
        }
    }

    /// <inheritdoc/>
    protected internal override void Delete() => Resources.State.DeleteVertexArray(_name);
}
