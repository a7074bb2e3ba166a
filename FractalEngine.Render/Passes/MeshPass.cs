using FractalEngine.Core.Geometry;
using FractalEngine.Render.Gl;
using FractalEngine.Render.Windowing;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Passes;

/// <summary>The program that draws lit, instanced triangles.</summary>
internal sealed class MeshPass : IDisposable
{
    /// <summary>Where the program expects the object's block.</summary>
    public const int ObjectBinding = 0;

    /// <summary>Where the program expects the lights.</summary>
    public const int LightBinding = 1;

    private static readonly Colour WireColour = new(0.80, 0.83, 0.87);

    private readonly ShaderProgram _program;
    private readonly ViewUniforms _view;
    private readonly int _flatColour;
    private bool? _lastWireframe;

    /// <summary>Builds the program.</summary>
    public MeshPass(RenderContext context)
    {
        _program = ShaderProgram.Load(context.Resources, "mesh");
        _program.BindBlock("ObjectBlock", ObjectBinding);
        _program.BindBlock("LightBlock", LightBinding);
        _view = new(_program, context.HasReversedDepth);
        _flatColour = _program.Uniform("flatColour");
    }

    /// <summary>Makes the program current and brings its uniforms up to date.</summary>
    /// <param name="view">Camera and projection.</param>
    /// <param name="aspect">Width divided by height of the viewport.</param>
    /// <param name="bounds">Of everything there is.</param>
    /// <param name="wireframe">Light grey lines instead of lit surfaces.</param>
    public void Begin(View view, double aspect, BoundingBox bounds, bool wireframe)
    {
        _program.Use();
        _view.Set(view, aspect, bounds);
        if (_lastWireframe != wireframe)
        {
            var (red, green, blue) = WireColour.ToLinear();
            GL.Uniform4(_flatColour, (float)red, (float)green, (float)blue, wireframe ? 1 : 0);
            _lastWireframe = wireframe;
        }

        GlShim.SetWireframe(wireframe);
    }

    /// <summary>Chooses which side of the triangles is not drawn.</summary>
    /// <param name="front">True for the front, false for the back; null to draw both.</param>
    public static void LeaveOut(bool? front)
    {
        if (front is { } side)
        {
            GL.Enable(EnableCap.CullFace);
            GlShim.SetCulledSide(side);
        }
        else
        {
            GL.Disable(EnableCap.CullFace);
        }
    }

    /// <summary>Leaves filled triangles with both sides for whoever draws next.</summary>
    public static void End()
    {
        LeaveOut(null);
        GlShim.SetWireframe(false);
    }

    /// <inheritdoc/>
    public void Dispose() => _program.Dispose();
}
