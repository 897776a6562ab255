-- A page of the manual: its title is its first heading, links lead to the HTML pages, a line on top leads to the contents.
local to_top = ""

local function html(target)
  if target:match("^%a+:") then return target end
  -- The results lie beside the manual's folder in the sources, and in it among the pages.
  target = target:gsub("^%.%./(.*results%.md)", "%1")
  target = target:gsub("^manual/", "")
  return (target:gsub("%.md$", ".html"):gsub("%.md#", ".html#"))
end

function Pandoc(document)
  to_top = document.meta.to_top and pandoc.utils.stringify(document.meta.to_top) or ""
  for _, block in ipairs(document.blocks) do
    if block.t == "Header" and block.level == 1 then
      document.meta.pagetitle = pandoc.utils.stringify(block) .. " – UCHILSIM"
      break
    end
  end
  document.meta.lang = "en"
  document = document:walk({
    Link = function(link)
      link.target = html(link.target)
      return link
    end
  })
  local contents = pandoc.Link("UCHILSIM manual", to_top .. "index.html")
  table.insert(document.blocks, 1, pandoc.Div({pandoc.Plain({contents})}, pandoc.Attr("", {"contents"})))
  return document
end
