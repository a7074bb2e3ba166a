using FractalEngine.App.Window.State;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Core.Scenes.Films;
using FractalEngine.Render.Views;

namespace FractalEngine.Tests.App.Window.State;

/// <summary>Tests where a film in a window stands, and which numbers it wants.</summary>
public class FilmPlayerTests
{
    private static readonly Film Numbers = new(2) { Keys = [new NumberKey(0, "a", 1), new NumberKey(2, "a", 3)] };

    [Fact]
    public void Stop_AfterNumbersWereLoaded_WantsThoseOfTheFiles()
    {
        var player = new FilmPlayer(Numbers, Handedness.Left, null);
        Assert.False(player.NeedsLoad);
        player.Seek(1);
        Assert.True(player.NeedsLoad);
        Assert.Equal(1, player.BeginLoad());
        Assert.False(player.NeedsLoad);
        player.Stop();
        Assert.True(player.NeedsLoad);
        Assert.Null(player.BeginLoad());
        Assert.False(player.NeedsLoad);
    }

    [Fact]
    public void Toggle_AtTheEnd_PlaysFromTheBeginning()
    {
        var player = new FilmPlayer(Numbers, Handedness.Left, null);
        player.Seek(9);
        Assert.Equal((2, false), (player.Time, player.IsPlaying));
        player.Toggle();
        Assert.Equal((0, true), (player.Time, player.IsPlaying));
        player.Advance(1.5);
        Assert.Equal((1.5, true), (player.Time, player.IsPlaying));
        player.Advance(0.5);
        Assert.Equal((2, false), (player.Time, player.IsPlaying));
    }

    [Fact]
    public void Lines_OfAPath_HaveNoneWhereTheCameraJumps()
    {
        // A mark of five axes at each of three keys, and 32 parts of each way.
        Assert.Equal(15 + 64, LinesOf(Ease.Linear).Count);
        var lines = LinesOf(Ease.Hold);
        Assert.Equal(15 + 32, lines.Count);
        Assert.DoesNotContain(lines, static line => line.To.X is > 0.2 and < 0.8);

        static IReadOnlyList<LineSegment> LinesOf(Ease ease)
        {
            var keys = ((Vector[])[Vector.Zero, Vector.I, Vector.I + Vector.J]).Select(
                (position, time) => new CameraKey(time, new(position, Vector.Zero, 50)) { Ease = time == 1 ? ease : Ease.Linear });
            return new FilmPlayer(new(2) { Keys = [.. keys] }, Handedness.Left, null) { ShowsPath = true }.Lines;
        }
    }

    /// <summary>The window goes on with a film that was edited meanwhile.</summary>
    [Fact]
    public void Player_OfAFilmThatWasMadeShorter_StandsAtItsEnd()
    {
        var player = new FilmPlayer(Numbers, Handedness.Left, null);
        player.Seek(1.5);
        player = new(Numbers with { Duration = 1, Keys = [new NumberKey(0, "a", 1)] }, Handedness.Left, player);
        Assert.Equal(1, player.Time);
    }
}
