using FractalEngine.Core.Scenes;
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
    // 100 MB of the GPU, and more than what most screens show of a turn.
    private const int MaxColumns = 4096;

    private readonly GlResources _resources;
    private readonly ShaderProgram _program;
    private readonly VertexArray _vertexArray;
    private readonly FloatTexture? _image;
    private readonly float[] _axes = new float[9];

    /// <summary>Builds the program for the sky of a scene, and uploads its image.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="scene">A scene with a sky.</param>
    /// <exception cref="GlException">The driver refuses the program, or the memory does not suffice.</exception>
    public SkyPass(GlResources resources, Scene scene)
    {
        _resources = resources;
        var radiance = scene.Sky!.ToRadiance(scene.Handedness);
        _program = new(resources, "sky", radiance is ImageRadiance ? ["SKY_IMAGE"] : []);
        _program.BindBlock("LightBlock", GlState.LightBinding);
        _program.Use();
        if (radiance is ImageRadiance sky)
        {
            var image = sky.Image.LevelOf(MaxColumns);
            _image = new(resources, "sky image", image.Width, image.Height, [image.Pixels]);
            _program.Set("place", sky.AheadU, sky.Forward);
            _program.Set("scale", sky.Scale);
        }
        else if (radiance is ColourRadiance colours)
        {
            _program.Set("zenith", colours.Zenith);
            _program.Set("horizon", colours.Horizon);
            _program.Set("ground", colours.Ground);
        }

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
        _program.Set("offset", 2 * frame.Offset.X / frame.Width, 2 * frame.Offset.Y / frame.Height);
        _resources.State.Cull(CullFace.None);
        GL.Disable(EnableCap.DepthTest);
        _image?.Bind();
        _vertexArray.Bind();
        GL.DrawArrays(PrimitiveType.Triangles, 0, 3);
        GL.Enable(EnableCap.DepthTest);
    }

    /// <inheritdoc/>
    public void Dispose() => GlObject.DisposeAll(_vertexArray, _image, _program);
}
