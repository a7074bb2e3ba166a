using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Films;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Tests.Support;
using FsCheck;
using FsCheck.Fluent;

namespace FractalEngine.Tests.Parsing.Sdo;

/// <summary>Tests films in scene files: what their lines mean, how they are written, and what is said of faulty ones.</summary>
public class FilmParserTests
{
    private static readonly Gen<Vector> AnyVector = Laws.AnyFinite.Select(static number => Math.Clamp(number, -1e150, 1e150)).Three()
        .Select(static t => new Vector(t.Item1, t.Item2, t.Item3));

    private static readonly Gen<Ease> Eases = Gen.Elements(Enum.GetValues<Ease>());

    // A number may be called like the camera, or like a word of the grammar.
    private static readonly Gen<FilmKey> Keys = Gen.OneOf(
        Gen.Elements("c", "at", "ease", "lean-angle", "größe").Zip(Laws.AnyFinite, (name, value) => (FilmKey)new NumberKey(0, name, value)),
        AnyVector.Two().Zip(Gen.Choose(1, 179), (v, angle) => (FilmKey)new CameraKey(0, new(v.Item1, v.Item2, angle))),
        AnyVector.Three().Where(v => v.Item1 != v.Item2 && v.Item3 != Vector.Zero).Zip(Gen.Elements(true, false),
            (v, isUp) => (FilmKey)new CameraKey(0, new(v.Item1, Vector.Zero, 0.1)) { Target = (v.Item2, isUp ? Vector.J : v.Item3) }));

    private static readonly Gen<Film> Films = Keys.Zip(Eases, (key, ease) => key with { Ease = ease }).ArrayOf()
        .Zip(Gen.Choose(1, 3600), (keys, duration) => new Film(duration)
        {
            // Rounded thirds, so that all digits count.
            Keys = [.. keys.Select((key, index) => key with { Time = duration * (index / (3.0 * keys.Length)) })],
        });

    [Fact]
    public void Write_AnyFilm_ReadsBackEqual() => Laws.CheckForAll(Films, film =>
    {
        var scene = new Scene { Film = film, Objects = [new("a.obj", Transformation.Identity)] };
        string text = SceneWriter.Write(scene);
        var parsed = SceneParser.Parse(new("test.sdo", text));
        Assert.Equal(scene, parsed.Scene);
        Assert.Equal(text, SceneWriter.Write(parsed.Scene, parsed));
    });

    [Fact]
    public void Parse_KeysOfAllKinds_HaveTheirMeaning()
    {
        var film = SceneParser.Parse(new("test.sdo", """
            # A film
            film 10.5
            at 0, c (0,2,9) look-at (0,0,0) 45
            at 0 angle=20
            at 4 c (5,3,4), look-at (0,1,0) up (1,0,0), 40 ease in-out
            at 4.5 c (5,3,4) # 40  ease  hold
              at 10.5 c = -6e1 ease in
            at 10.5 angle = 60 ease out
            """)).Scene.Film!;
        Assert.Equal(10.5, film.Duration);
        FilmKey[] expected =
        [
            new CameraKey(0, new(new(0, 2, 9), Vector.Zero, 45)) { Target = (Vector.Zero, Vector.J) },
            new NumberKey(0, "angle", 20),
            new CameraKey(4, new(new(5, 3, 4), Vector.Zero, 40)) { Target = (Vector.J, Vector.I), Ease = Ease.InOut },
            new CameraKey(4.5, new(new(5, 3, 4), Vector.Zero, 40)) { Ease = Ease.Hold },
            new NumberKey(10.5, "c", -60) { Ease = Ease.In },
            new NumberKey(10.5, "angle", 60) { Ease = Ease.Out },
        ];
        Assert.Equal(expected.Length, film.Keys.Length);
        Assert.All(expected.Zip(film.Keys), static pair => Assert.Equal(pair.First, pair.Second));
    }

    [Fact]
    public void Write_OneKeyChanged_KeepsTheOtherLines()
    {
        const string text = "film   2\n# first\nat 0   a=1\nat 1  a = 2\nat 2   a=3 # ";
        var parsed = SceneParser.Parse(new("test.sdo", text[..^3]));
        var film = parsed.Scene.Film!;
        var changed = film with { Keys = film.Keys.SetItem(1, new NumberKey(1, "a", 5) { Ease = Ease.Out }) };
        Assert.Equal(
            "film   2\n# first\nat 0   a=1\nat 1 a = 5 ease out\nat 2   a=3",
            SceneWriter.Write(parsed.Scene with { Film = changed }, parsed));
        Assert.Equal("# first\n", SceneWriter.Write(parsed.Scene with { Film = null }, parsed));
    }

    [Theory]
    [InlineData("film 0", 1, 6, "a film lasts more than 0 and at most 3600 seconds")]
    [InlineData("film 3601", 1, 6, "a film lasts more than 0 and at most 3600 seconds")]
    [InlineData("film 1\nfilm 2", 2, 1, "'film' is declared twice, first in line 1")]
    [InlineData("at 0 a = 1", 1, 4, "a key needs a line 'film SECONDS' above it")]
    [InlineData("film 1\nat 1.5 a = 1", 2, 4, "the time of a key must lie within the film, which lasts 1 seconds")]
    [InlineData("film 1\nat -1 a = 1", 2, 4, "the time of a key must not be negative")]
    [InlineData("film 9\nat 4 a = 1\nat 4 b = 1\nat 4 a = 1", 4, 4,
        "keys of one thing stand in the order of their times, and the one before is at 4 seconds")]
    [InlineData("film 9\nat 4 c # # 60\nat 3 c # # 60", 3, 4,
        "keys of one thing stand in the order of their times, and the one before is at 4 seconds")]
    [InlineData("film 9\nat 4 c # look-at (0, 0, 0) 60", 2, 18, "a camera can't look at its own position")]
    [InlineData("film 9\nat 4 c (1e151, 0, 0) # 60", 2, 6, "the camera of a key is beyond the limit of 1e150")]
    [InlineData("film 9\nat 4 c (1, 0, 0) look-at (1e151, 0, 0) 60", 2, 6, "the camera of a key is beyond the limit of 1e150")]
    [InlineData("film 9\nat 4 c # # 60 ease slow", 2, 20, "unexpected 'slow', expected 'linear', 'in-out', 'in', 'out' or 'hold'")]
    [InlineData("film 9\nat 4 a 3", 2, 8, "unexpected '3', expected '='")]
    [InlineData("film 9\nat 4 = 3", 2, 6, "unexpected '=', expected 'c' or the name of a number")]
    [InlineData("film 9\nat 4", 2, 5, "unexpected end of file, expected a blank or ','")]
    public void Parse_FaultyFilm_SaysWhereAndWhy(string text, int line, int column, string message)
    {
        string source = text.Split('\n')[line - 1];
        Errors.AssertMessage(
            $"test.sdo:{line}:{column}: error: {message}\n  {source}\n  {new string(' ', column - 1)}^",
            () => SceneParser.Parse(new("test.sdo", text)));
    }
}
