using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Lights;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Gl.State;
using FractalEngine.Render.Upload;
using FractalEngine.Render.Views;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Frame;

/// <summary>Fills a frame with the scene's sky, before anything else is drawn.</summary>
internal sealed class SkyPass : IDisposable
{
    private readonly GlResources _resources;
    private readonly ShaderProgram _program;
    private readonly VertexArray _vertexArray;
    private readonly float[] _axes = new float[9];

    /// <summary>Builds the program for the sky of a scene.</summary>
    /// <exception cref="GlException">The driver refuses the program.</exception>
    public SkyPass(GlResources resources, Sky sky)
    {
        _resources = resources;
        _program = new(resources, "sky");
        _program.BindBlock("LightBlock", GlState.LightBinding);
        _program.Use();
        _program.Set("zenith", sky.ZenithRadiance);
        _program.Set("horizon", sky.HorizonRadiance);
        _program.Set("ground", sky.GroundRadiance);
        // The vertices have no attributes, but OpenGL requires an array.
        _vertexArray = new(resources, "sky");
    }

    /// <summary>Draws into the bound framebuffer's viewport, without its depth. The light block must be bound.</summary>
    public void Draw(in FrameView frame)
    {
        _program.Use();
        ViewUniforms.WriteRows(frame.View.Camera.LocalAxesInverse, _axes);
        GL.Uniform3(_program.UniformLocation("cameraAxes"), 3, _axes);
        var halfHeight = frame.View.Projection == Projection.Perspective ? frame.View.HalfHeight : 0;
        _program.Set("halfSize", halfHeight * frame.Aspect, halfHeight);
        _resources.State.Cull(CullFace.None);
        GL.Disable(EnableCap.DepthTest);
        _vertexArray.Bind();
        GL.DrawArrays(PrimitiveType.Triangles, 0, 3);
        GL.Enable(EnableCap.DepthTest);
    }

    /// <inheritdoc/>
    public void Dispose() => GlObject.DisposeAll(_vertexArray, _program);
}
