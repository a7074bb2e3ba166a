using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Upload;
using FractalEngine.Render.Views;
using FractalEngine.Render.Windowing;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Frame;

/// <summary>Draws the surfaces of lamps: rectangles from their fronts, and balls. The light block has their places.</summary>
internal sealed class LampsPass : IDisposable
{
    // Two triangles for each cell of the grid in lamps.vert.
    private const int VertexCount = 6 * 6 * 96;

    private readonly GlState _state;
    private readonly int _lightCount;
    private readonly ShaderProgram _program;
    private readonly ViewUniforms _viewUniforms;
    private readonly VertexArray _vertexArray;

    /// <summary>Builds the program for the lights of a scene.</summary>
    /// <param name="context">Current context.</param>
    /// <param name="lightCount">Number of lights in the block.</param>
    /// <exception cref="GlException">The driver refuses the program.</exception>
    public LampsPass(RenderContext context, int lightCount)
    {
        _state = context.Resources.State;
        _lightCount = lightCount;
        _program = new(context.Resources, "lamps");
        _program.BindBlock("LightBlock", GlState.LightBinding);
        _viewUniforms = new(_program, _state.Filter, context.HasReversedDepth);
        // The vertices have no attributes, but OpenGL requires an array.
        _vertexArray = new(context.Resources, "lamps");
    }

    /// <summary>Draws into the bound framebuffer. The light block must be bound.</summary>
    public void Draw(in FrameView frame)
    {
        _program.Use();
        _viewUniforms.Set(in frame);
        _state.Cull(CullFace.None);
        _vertexArray.Bind();
        GL.DrawArraysInstanced(PrimitiveType.Triangles, 0, VertexCount, _lightCount);
    }

    /// <inheritdoc/>
    public void Dispose() => GlObject.DisposeAll(_vertexArray, _program);
}
