using FractalEngine.Core.Maths;
using FractalEngine.Render.Gl.State;
using OpenTK.Graphics.OpenGL4;

namespace FractalEngine.Render.Gl;

/// <summary>A linked program of a vertex shader and a fragment shader.</summary>
internal class ShaderProgram : GlObject
{
    private readonly (string Vertex, string Fragment) _sources;
    private readonly int _name;
    private readonly bool _isLinked;
    private readonly Dictionary<string, int> _locations = [];

    /// <summary>Compiles and links sources, unless the context has kept a program of them.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="vertex">File name, for messages, and source text of the vertex shader.</param>
    /// <param name="fragment">File name and source text of the fragment shader.</param>
    /// <exception cref="GlException">The driver refuses a shader. The message has the stage, the file and the driver's log.</exception>
    public ShaderProgram(GlResources resources, (string File, string Text) vertex, (string File, string Text) fragment)
        : base(resources, $"{vertex.File} + {fragment.File}")
    {
        _sources = (vertex.Text, fragment.Text);
        _isLinked = resources.TryTakeProgram(_sources, out _name);
        if (!_isLinked)
        {
            _name = GL.CreateProgram();
            DisposeOnFailure(this, () => Build(vertex, fragment));
            _isLinked = true;
        }
    }

    /// <summary>Builds the embedded files <c>Shaders/name.vert</c> and <c>Shaders/name.frag</c>.</summary>
    /// <param name="resources">Resources of the current context.</param>
    /// <param name="name">Common name of both files.</param>
    /// <param name="symbols">Symbols that are defined in both.</param>
    /// <exception cref="GlException">The driver refuses a shader.</exception>
    public ShaderProgram(GlResources resources, string name, params IReadOnlyList<string> symbols)
        : this(resources, Read($"{name}.vert", symbols), Read($"{name}.frag", symbols))
    {
    }

    /// <summary>Makes this the current program.</summary>
    public void Use() => Resources.State.UseProgram(_name);

    /// <summary>Sets a uniform of type int, or the texture unit of a sampler. This program must be in use, as for all uniforms.</summary>
    public void Set(string uniform, int value) => GL.Uniform1(UniformLocation(uniform), value);

    /// <summary>Sets a uniform of type float.</summary>
    public void Set(string uniform, double value) => GL.Uniform1(UniformLocation(uniform), (float)value);

    /// <summary>Sets a uniform of type vec2.</summary>
    public void Set(string uniform, double x, double y) => GL.Uniform2(UniformLocation(uniform), (float)x, (float)y);

    /// <summary>Sets a uniform of type vec3.</summary>
    public void Set(string uniform, Vector value) =>
        GL.Uniform3(UniformLocation(uniform), (float)value.X, (float)value.Y, (float)value.Z);

    /// <summary>Sets a uniform of type vec4.</summary>
    public void Set(string uniform, double x, double y, double z, double w) =>
        GL.Uniform4(UniformLocation(uniform), (float)x, (float)y, (float)z, (float)w);

    /// <summary>Returns the location of a uniform; −1 where the compiler removed it, which GL ignores.</summary>
    public int UniformLocation(string name) =>
        _locations.TryGetValue(name, out var known) ? known : _locations[name] = GL.GetUniformLocation(_name, name);

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
    protected internal sealed override void Delete()
    {
        if (_isLinked)
        {
            Resources.KeepProgram(_sources, _name);
        }
        else
        {
            Resources.State.DeleteProgram(_name);
        }
    }

    private static (string File, string Text) Read(string file, IReadOnlyList<string> symbols) => (file, ShaderSource.Read(file, symbols));

    private void Build((string File, string Text) vertex, (string File, string Text) fragment)
    {
        var vertexShader = 0;
        var fragmentShader = 0;
        try
        {
            vertexShader = Compile(ShaderType.VertexShader, vertex);
            fragmentShader = Compile(ShaderType.FragmentShader, fragment);
            GL.AttachShader(_name, vertexShader);
            GL.AttachShader(_name, fragmentShader);
            GL.LinkProgram(_name);
            GL.GetProgram(_name, GetProgramParameterName.LinkStatus, out var isLinked);
            if (isLinked == 0)
            {
                throw new GlException($"{Label} does not link:\n{GL.GetProgramInfoLog(_name).Trim()}");
            }
        }
        finally
        {
            // An attached shader lives until its program is deleted; GL ignores 0.
            GL.DeleteShader(vertexShader);
            GL.DeleteShader(fragmentShader);
        }
    }

    private static int Compile(ShaderType stage, (string File, string Text) source)
    {
        var shader = GL.CreateShader(stage);
        GL.ShaderSource(shader, source.Text);
        GL.CompileShader(shader);
        GL.GetShader(shader, ShaderParameter.CompileStatus, out var isCompiled);
        if (isCompiled != 0)
        {
            return shader;
        }

        var log = GL.GetShaderInfoLog(shader).Trim();
        GL.DeleteShader(shader);
        throw new GlException(
            $"{source.File} ({(stage == ShaderType.VertexShader ? "vertex" : "fragment")} shader) does not compile:\n{log}");
    }
}
