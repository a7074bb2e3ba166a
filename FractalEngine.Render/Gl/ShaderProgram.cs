using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>A vertex and a fragment shader, linked.</summary>
internal sealed class ShaderProgram : GlObject
{
    private readonly int _name;

    /// <summary>Compiles and links sources.</summary>
    /// <param name="resources">Of the current context.</param>
    /// <param name="vertex">File name, for messages, and text of the vertex shader.</param>
    /// <param name="fragment">The same of the fragment shader.</param>
    /// <exception cref="GlException">The driver refuses one; the message names the stage and the file and has the driver's log.</exception>
    public ShaderProgram(GlResources resources, (string File, string Text) vertex, (string File, string Text) fragment)
        : base(resources, $"{vertex.File} + {fragment.File}")
    {
        _name = GL.CreateProgram();
        try
        {
            Build(vertex, fragment);
        }
        catch
        {
            Dispose();
            throw;
        }
    }

    /// <summary>Builds the embedded files <c>Shaders/name.vert</c> and <c>Shaders/name.frag</c>.</summary>
    /// <param name="resources">Of the current context.</param>
    /// <param name="name">Of both files.</param>
    /// <param name="symbols">Defined in both.</param>
    public static ShaderProgram Load(GlResources resources, string name, params IReadOnlyList<string> symbols) =>
        new(resources, Read($"{name}.vert", symbols), Read($"{name}.frag", symbols));

    /// <summary>Makes this the current program.</summary>
    public void Use() => Resources.State.UseProgram(_name);

    /// <summary>The location of a uniform; −1 where the compiler left it out, which GL ignores.</summary>
    public int UniformLocation(string name) => GL.GetUniformLocation(_name, name);

    /// <summary>Connects a uniform block to a binding point.</summary>
    /// <exception cref="GlException">The program has no such block.</exception>
    public void BindBlock(string block, int bindingPoint)
    {
        var index = GL.GetUniformBlockIndex(_name, block);
        if (index < 0)
        {
            throw new GlException($"{this} has no uniform block {block}");
        }

        GL.UniformBlockBinding(_name, index, bindingPoint);
    }

    /// <inheritdoc/>
    protected override void Delete() => Resources.State.DeleteProgram(_name);

    private static (string File, string Text) Read(string file, IReadOnlyList<string> symbols) => (file, ShaderSource.Read(file, symbols));

    private void Build((string File, string Text) vertex, (string File, string Text) fragment)
    {
        var (vertexShader, fragmentShader) = (0, 0);
        try
        {
            vertexShader = Compile(ShaderType.VertexShader, vertex);
            fragmentShader = Compile(ShaderType.FragmentShader, fragment);
            GL.AttachShader(_name, vertexShader);
            GL.AttachShader(_name, fragmentShader);
            GL.LinkProgram(_name);
            GL.GetProgram(_name, GetProgramParameterName.LinkStatus, out var linked);
            if (linked == 0)
            {
                throw new GlException($"{Label} does not link:\n{GL.GetProgramInfoLog(_name).Trim()}");
            }
        }
        finally
        {
            // A deleted shader lives on until its program goes; 0 is ignored.
            GL.DeleteShader(vertexShader);
            GL.DeleteShader(fragmentShader);
        }
    }

    private static int Compile(ShaderType stage, (string File, string Text) source)
    {
        var shader = GL.CreateShader(stage);
        GL.ShaderSource(shader, source.Text);
        GL.CompileShader(shader);
        GL.GetShader(shader, ShaderParameter.CompileStatus, out var compiled);
        if (compiled != 0)
        {
            return shader;
        }

        var log = GL.GetShaderInfoLog(shader).Trim();
        GL.DeleteShader(shader);
        throw new GlException(
            $"{source.File} ({(stage == ShaderType.VertexShader ? "vertex" : "fragment")} shader) does not compile:\n{log}");
    }
}
